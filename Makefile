# SPDX-License-Identifier: BSD-3-Clause
# make demo   install what is needed, build, label a cup and classify a tee
# make test   install what is needed, build, run the tests
PRESET ?= release
BUILD := build/$(PRESET)
TOPOSCOPE := $(BUILD)/bin/toposcope
# Compiling Eigen and Ceres takes about 1 GB a job.
JOBS ?= $(shell nproc)

.PHONY: all deps configure demo test format lint clean
all: configure
	cmake --build $(BUILD) -j $(JOBS)

deps:
	@./scripts/install-deps

configure: deps
	@mkdir -p build
	@cmake --preset $(PRESET) > $(BUILD).log 2>&1 || { cat $(BUILD).log; exit 1; }

demo: configure
	cmake --build $(BUILD) -j $(JOBS) --target program
	@mkdir -p demo
	$(TOPOSCOPE) sample cup --faces 20000 -o demo/cup.ply
	$(TOPOSCOPE) sample tee --faces 20000 -o demo/tee.ply
	$(TOPOSCOPE) classify demo/tee.ply --models pipe-fitting
	$(TOPOSCOPE) run demo/cup.ply --model cup --out demo

test: all
	ctest --preset $(PRESET) -j $(JOBS)

format:
	git ls-files '*.cpp' '*.h' | xargs clang-format -i

# Formatting everywhere; clang-tidy over the kernel and the plugins.
lint: configure
	git ls-files '*.cpp' '*.h' | xargs clang-format --dry-run -Werror
	git ls-files 'core/*.cpp' 'plugins/*.cpp' | xargs -P $(JOBS) -n 4 clang-tidy -p $(BUILD) --quiet

clean:
	rm -rf build demo
