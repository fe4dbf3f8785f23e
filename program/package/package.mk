# A Debian package, and a try on machines that QEMU emulates: docs/real_time_board.md. The Makefile includes this file
# after install.mk, and defines B, O, NAME, ARCH and RUNS.
DEBIAN_arm64 := arm64
DEBIAN_host   = $(shell dpkg --print-architecture)
DEBIAN        = $(DEBIAN_$(ARCH))

# By the time of the commit, so that a newer one is an upgrade, and the same one the same bytes.
COMMITTED = $(shell git log -1 --format=%ct 2>/dev/null || echo 0)
RELEASE   = $(firstword $(subst -, ,$(VERSION)))+$(shell date -u -d @$(COMMITTED) +%Y%m%d%H%M%S)$(shell \
              git describe --always --dirty 2>/dev/null | sed 's/^/./; s/-/./g')

.PHONY: deb package-test run-vm test-vm vm-programs
deb: $(if $(filter arm64,$(ARCH)),setup-arm64)              ## make the Debian package of BOARD, ARCH=arm64: for a board
	$(Q)$(if $(DEBIAN),,echo 'deb: ARCH=$(ARCH) has no package; host and arm64 have' >&2; exit 2)
	$(Q)$(if $(LDLIBS),echo 'deb: $(BOARD) simulates its robot; packages are for boards with a robot: fer_can$(comma) ur10_socket' >&2; exit 2)
	$(Q)rm -rf $(B)/package
	$(Q)umask 022; SOURCE_DATE_EPOCH=$(COMMITTED) $(MAKE) --no-print-directory install DESTDIR=$(CURDIR)/$(B)/package PREFIX=/usr
	$(Q)SOURCE_DATE_EPOCH=$(COMMITTED) program/package/build $(B)/package $(BOARD) $(DEBIAN) $(RELEASE) $(RUNS)
package-test: deb                                           ## install, remove and purge that package in a file system of its own
	$(Q)tests/package/install $(B)/*.deb || { [ $$? = 77 ] && echo 'package-test: SKIPPED, needs root' >&2; }

# Each machine with the drives as a second process, and the host's programs for comparison.
MACHINES_host  := amd64
MACHINES_arm64 := amd64 virt raspi3b
vm-programs: setup-vm trajectories
	$(Q)$(if $(filter fer_can,$(BOARD)),,echo 'run-vm: BOARD=$(BOARD) has no emulated drives; fer_can has' >&2; exit 2)
	$(Q)set -e; for board in fer_can fer_drives; do \
	  $(MAKE) --no-print-directory BOARD=$$board all; \
	  $(if $(filter host,$(ARCH)),,$(MAKE) --no-print-directory ARCH=host CXX=g++ BOARD=$$board all;) done
run-vm: vm-programs                           ## run fer_can beside emulated drives, ARCH=arm64: on boards; compare; out/vm
	$(Q)scripts/beside_drives run pipelines/$(RUNS).ini $(MACHINES_$(ARCH):%=--machine %) --out out/vm
test-vm: vm-programs                          ## test a short motion on the machines, with ARCH=arm64
	$(Q)$(if $(filter arm64,$(ARCH)),,echo 'test-vm: ARCH=arm64 has the machines to compare' >&2; exit 2)
	$(Q)scripts/run_tests tests/vm/boards
