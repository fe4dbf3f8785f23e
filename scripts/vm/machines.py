"""The machines that QEMU emulates. What makes one differ from another is here, and nowhere else."""

import dataclasses

# Of each architecture, in Debian's words: the package that depends on the newest kernel with PREEMPT_RT, the folder of
# its libraries, and its number in an ELF file.
KERNELS = {"amd64": "linux-image-rt-amd64", "arm64": "linux-image-rt-arm64"}
TRIPLETS = {"amd64": "x86_64-linux-gnu", "arm64": "aarch64-linux-gnu"}
ELF_MACHINES = {"amd64": 62, "arm64": 183}
# What is loaded, in groups: always, with emulated controllers, to switch off, and to bring out results.
MODULES = {
    "bus": ["can-raw", "can-bcm", "can-gw", "vcan", "vxcan"],
    "controllers": ["kvaser_pci"],
    "watchdog": ["bcm2835_wdt"],
    "virtio": ["virtio_pci", "virtio_console"],
    "card": ["bcm2835"],
}
VIRTIO_RESULTS = ("-device virtio-serial -chardev file,id=results,path={folder}/results "
                  "-device virtserialport,chardev=results")  # fmt: skip


@dataclasses.dataclass(frozen=True)
class Machine:
    """A board. The lines of options have {folder} and {kernel} where QEMU needs the paths."""

    architecture: str
    qemu: str  # the emulator and the board
    append: str  # the kernel's command line
    ports: str  # where the kernel writes (file console), the command (output), and what is left in /out (results)
    output: str  # device of the command's output
    results: str  # device of the results
    results_modules: str  # the group that is loaded after the command
    clock: str  # the clock source that has the resolution of the processor's counter
    modules: tuple = ("bus",)  # the groups that are loaded at first
    controllers: bool = False  # CAN controllers on PCI can be emulated
    tree: str = ""  # the device tree, of the kernel's package
    absent: tuple = ()  # what the tree has and QEMU does not emulate


MACHINES = {
    "amd64": Machine(
        architecture="amd64",
        qemu="qemu-system-x86_64 -cpu qemu64 -smp 1 -m 512",
        # Calibrations and self-tests take a kernel under emulation twice as long as all the rest. A counter that counts
        # instructions needs none: 1 GHz. The timer in the processor would be measured, that of the board need not.
        append="console=ttyS0 tsc_early_khz=1000000 nolapic_timer initcall_blacklist=hpet_init",
        ports=f"-serial file:{{folder}}/console -serial file:{{folder}}/output {VIRTIO_RESULTS}",
        output="/dev/ttyS1",
        results="/dev/vport0p1",
        results_modules="virtio",
        clock="tsc",
        controllers=True,
    ),
    "virt": Machine(
        architecture="arm64",
        qemu="qemu-system-aarch64 -M virt -cpu cortex-a72 -smp 1 -m 512",
        append="console=ttyAMA0",
        ports=f"-serial file:{{folder}}/console -chardev file,id=output,path={{folder}}/output "
        f"-device pci-serial,chardev=output {VIRTIO_RESULTS}",
        output="/dev/ttyS0",
        results="/dev/vport0p1",
        results_modules="virtio",
        clock="arch_sys_counter",
        controllers=True,
    ),
    "raspi3b": Machine(
        architecture="arm64",
        qemu="qemu-system-aarch64 -M raspi3b -m 1G -dtb {kernel}/raspi3b.dtb",
        # Its four processors take turns under a clock that counts instructions, each until the next timer: one that
        # spins while another holds a lock loses milliseconds. So one works and three idle. The first two levels of
        # messages are enough: the clock of the serial port is not emulated, and its driver says so.
        append="console=ttyS1,115200 isolcpus=1-3 nohz_full=1-3 rcu_nocbs=1-3 loglevel=3",
        ports="-serial file:{folder}/output -serial file:{folder}/console "
        "-drive if=sd,format=raw,file={folder}/results",
        output="/dev/ttyAMA0",
        results="/dev/mmcblk0",
        results_modules="card",
        clock="arch_sys_counter",
        modules=("bus", "watchdog"),  # the board has no other switch: reboot by the watchdog ends QEMU
        tree="broadcom/bcm2837-rpi-3-b.dtb",
        absent=("/soc/serial@7e201000/bluetooth",),  # or its serial port would be no terminal
    ),
}
