# A Debian package, and a try on machines that QEMU emulates: docs/real_time_board.md. The Makefile includes this file
# after install.mk, and defines B, O, NAME, ARCH and RUNS.
DEBIAN_arm64 := arm64
DEBIAN_host   = $(shell dpkg --print-architecture)
DEBIAN        = $(DEBIAN_$(ARCH))

# By the time of the commit, so that a newer one is an upgrade, and the same one the same bytes.
COMMITTED = $(shell git log -1 --format=%ct 2>/dev/null || echo 0)
RELEASE   = $(firstword $(subst -, ,$(VERSION)))+$(shell date -u -d @$(COMMITTED) +%Y%m%d%H%M%S)$(shell \
              git describe --always --dirty 2>/dev/null | sed 's/^/./; s/-/./g')

.PHONY: deb run-vm
deb: $(if $(filter arm64,$(ARCH)),setup-arm64)              ## make the Debian package of BOARD, ARCH=arm64: for a board
	$(Q)$(if $(DEBIAN),,echo 'deb: ARCH=$(ARCH) has no package; host and arm64 have' >&2; exit 2)
	$(Q)$(if $(LDLIBS),echo 'deb: $(BOARD) simulates its robot; packages are for boards with a robot: fer_can$(comma) ur10_socket' >&2; exit 2)
	$(Q)rm -rf $(B)/package
	$(Q)SOURCE_DATE_EPOCH=$(COMMITTED) $(MAKE) --no-print-directory install DESTDIR=$(CURDIR)/$(B)/package PREFIX=/usr
	$(Q)SOURCE_DATE_EPOCH=$(COMMITTED) program/package/build $(B)/package $(BOARD) $(DEBIAN) $(RELEASE) $(RUNS)

# Each machine with the drives as a second process, and the host's programs for comparison.
MACHINES_host  := amd64
MACHINES_arm64 := amd64 virt raspi3b
run-vm: setup-vm trajectories                               ## run the FER beside emulated drives on the machines of ARCH, and compare
	$(Q)$(if $(filter fer_can,$(BOARD)),,echo 'run-vm: BOARD=fer_can is the board with emulated drives' >&2; exit 2)
	$(Q)set -e; for board in fer_can fer_drives; do \
	  $(MAKE) --no-print-directory BOARD=$$board all; \
	  $(if $(filter host,$(ARCH)),,$(MAKE) --no-print-directory ARCH=host CXX=g++ BOARD=$$board all;) done
	$(Q)scripts/beside_drives run pipelines/$(RUNS).ini $(MACHINES_$(ARCH):%=--machine %) --out out/vm
