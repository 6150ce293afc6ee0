# SPDX-License-Identifier: BSD-3-Clause
# make demo   maps from real and simulated scans, with pictures and an accuracy table, in demo/
# make test   builds and runs every test
# make bench  speed, room by room and against MRPT's COctoMap
# make help   the other targets

# Outside data that some tests and benchmarks use; they skip, saying so, without it.
AKIMAP_DATA ?= ../shared/data
export AKIMAP_DATA := $(abspath $(AKIMAP_DATA))

BUILD ?= build
JOBS ?= 2
CMAKE_FLAGS ?=

PACKAGES := build-essential cmake libmrpt-maps-dev libmrpt-apps-dev \
  libmrpt-hwdrivers-dev libmrpt-topography-dev mrpt-apps mrpt-common zlib1g-dev \
  libeigen3-dev libtbb-dev libnanoflann-dev libcli11-dev nlohmann-json3-dev liboctomap-dev \
  libcairo2-dev fonts-dejavu-core libgtest-dev libbenchmark-dev libxml2-utils \
  libegl1 libgl1-mesa-dri xvfb xauth xdotool netpbm

# What akimap is built without where the system has no such packages: ROS 1 bags.
OPTIONAL_PACKAGES := librosbag-storage-dev libsensor-msgs-dev libnav-msgs-dev libtf2-msgs-dev

.PHONY: all configure deps demo test bench bench-instructions benchmark ablations doc-mrpt asan tsan soak fuzz test-trixie format clean help
.DEFAULT_GOAL := all

all: configure
	@cmake --build $(BUILD) -j$(JOBS) -- --no-print-directory

configure: deps
	@mkdir -p $(BUILD)
	@cmake -S . -B $(BUILD) $(CMAKE_FLAGS) >$(BUILD)/configure.log 2>&1 || { cat $(BUILD)/configure.log; exit 1; }

# Installs what is missing, and only that.
deps:
	@known=$$(for p in $(OPTIONAL_PACKAGES); do apt-cache show $$p >/dev/null 2>&1 && echo $$p; done); \
	missing=$$(for p in $(PACKAGES) $$known; do \
	    dpkg-query -W -f '$${Status}' $$p 2>/dev/null | grep -q 'ok installed' || echo $$p; done); \
	[ -z "$$missing" ] && exit 0; \
	echo "Missing packages:" $$missing; \
	if [ "$$(id -u)" = 0 ]; then sudo=; elif command -v sudo >/dev/null; then sudo=sudo; else \
	    echo "Neither root nor sudo. Have them installed with:"; \
	    echo "  apt-get install --no-install-recommends" $$missing; exit 1; fi; \
	echo "Installing them: $$sudo apt-get install --no-install-recommends" $$missing; \
	$$sudo apt-get update -qq && \
	$$sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $$missing >/dev/null

demo: configure
	@cmake --build $(BUILD) -j$(JOBS) --target akimap_program bench_accuracy -- --no-print-directory
	@share/akimap/demo.sh $(BUILD)/bin demo

test: all
	@cd $(BUILD) && ctest --output-on-failure --progress -j$(JOBS)

# BENCHMARK.md and its pictures: every figure in them, in some half an hour. benchmarks/data.sh
# makes the recordings.
benchmark: export LA3DM_DIR ?= $(AKIMAP_DATA)/la3dm
benchmark: configure
	@cmake --build $(BUILD) -j$(JOBS) --target benchmark_report -- --no-print-directory
	@$(BUILD)/bin/benchmark_report --commit "$$(git rev-parse --short HEAD 2>/dev/null || echo unknown)"

bench: all
	@$(BUILD)/bin/bench_speed
	@$(BUILD)/bin/bench_storage
	@$(BUILD)/bin/bench_rooms --benchmark_min_time=0.2

# Instructions of each room on a fixed workload, by valgrind.
bench-instructions: PACKAGES += valgrind
bench-instructions: configure
	@cmake --build $(BUILD) -j$(JOBS) --target bench_instructions -- --no-print-directory
	@benchmarks/instructions.sh $(BUILD)/bin

# What each choice of the default estimator is worth, one changed at a time: a table of
# doc/design.md. ROWS: only those whose names match this pattern.
ablations: deps
	@JOBS=$(JOBS) benchmarks/ablations.sh "$(ROWS)"

# The tables of doc/mrpt.md, for the MRPT that is installed here.
doc-mrpt: configure
	@cmake --build $(BUILD) -j$(JOBS) --target mrpt_table -- --no-print-directory
	@$(BUILD)/bin/mrpt_table --write doc/mrpt.md

asan tsan: deps
	@cmake --preset $@ >/dev/null
	@$(MAKE) --no-print-directory test BUILD=build-$@

# 8 hours of scans at 10 Hz in a room and along a corridor, and what readers cost a writer.
soak: configure
	@cmake --build $(BUILD) -j$(JOBS) --target soak -- --no-print-directory
	@$(BUILD)/bin/soak

# Each reader of files under clang's libFuzzer, AddressSanitizer and UBSan, one after the other.
FUZZ_SECONDS ?= 1800
fuzz: PACKAGES += clang libclang-rt-dev
fuzz: deps
	@cmake --preset fuzz >/dev/null
	@cmake --build build-fuzz -j$(JOBS) -- --no-print-directory
	@tests/fuzz/run.sh build-fuzz $(FUZZ_SECONDS)

# The same on MRPT 2.14, in a Debian 13 chroot (root, debootstrap; about 5 GB and half an hour).
test-trixie:
	@JOBS=$(JOBS) CMAKE_FLAGS="$(CMAKE_FLAGS)" .ci/test-trixie

format:
	@git ls-files '*.cpp' '*.h' | xargs clang-format -i

clean:
	@rm -rf build build-ablations build-asan build-fuzz build-tsan demo

help:
	@echo "make demo    maps from real and simulated scans, with pictures and an accuracy table"
	@echo "make test    build and run every test (AKIMAP_DATA=$(AKIMAP_DATA))"
	@echo "make bench   speed, room by room and against MRPT's COctoMap"
	@echo "make bench-instructions   instructions of each room on a fixed workload"
	@echo "make doc-mrpt   doc/mrpt.md: what MRPT's 3D maps answer, call by call"
	@echo "make benchmark   accuracy and speed beside other maps: writes BENCHMARK.md (AKIMAP_DATA=...)"
	@echo "make ablations   accuracy with one thing in the default estimator changed at a time (ROWS=PATTERN)"
	@echo "make asan    the tests under AddressSanitizer and UBSan, but for stock programs and viewers"
	@echo "make tsan    the same under ThreadSanitizer"
	@echo "make soak    8 hours of scans, and readers beside a writer"
	@echo "make fuzz    each reader of files under libFuzzer, FUZZ_SECONDS=1800 each"
	@echo "make test-trixie    the tests on MRPT 2.14, in a Debian 13 chroot"
	@echo "make format  clang-format every source file"
	@echo "make clean   remove build*/ and demo/"
