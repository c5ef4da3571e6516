# SPDX-License-Identifier: BSD-3-Clause
# make demo   install what is needed, build, label a cup and classify a tee
# make test   install what is needed, build, run the tests
# make pages   renew the tables of options in the plugins' pages
# make docs   one site of all pages, the models' pictures and the headers' reference, in build/site
# make abi    record the plugin ABI of a new version
# make packages   the Debian packages
# make evaluate   measure: made and real meshes against their truth, tables in evaluation/
# make screenshots   pictures of reports for the docs
# make failing   a run in which one allocation, write, open or rename fails, for each place that makes one: half an hour
# make fuzz   fuzz all that reads files, FUZZ_SECONDS for each format (FUZZ="model cfn": these alone)
PRESET ?= release
BUILD := build/$(PRESET)
TOPOSCOPE := $(BUILD)/bin/toposcope
# Compiling Eigen and Ceres takes about 1 GB a job.
JOBS ?= $(shell nproc)

.PHONY: all deps configure demo test packages pages docs abi evaluate screenshots bench failing fuzz format style lint clean
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

# The tables of options in the plugins' pages, from their descriptors; a test fails where they differ.
pages: configure
	cmake --build $(BUILD) -j $(JOBS) --target program
	for page in plugins/*/*/*.md; do \
	  $(TOPOSCOPE) plugins describe $$(basename $$page .md) --page $$page || exit 1; \
	done

# One browsable site, build/site/index.html; links, citations and examples are tried, doxygen's warnings shown.
docs: configure
	@./scripts/install-deps doxygen python3-markdown-it
	cmake --build $(BUILD) -j $(JOBS) --target program
	ctest --preset $(PRESET) -R '^docs_'
	./scripts/docs/site.py $(TOPOSCOPE) build/site

# Records the layout of the plugin boundary under its version, where there is no record yet.
abi: configure
	cmake --build $(BUILD) -j $(JOBS) --target abi_record
	cmake -DRECORD=$(BUILD)/bin/abi_record -DSOURCE=$(CURDIR) -DWRITE=ON -P abi/abi_test.cmake

# Debian packages: toposcope, toposcope-plugins, libtoposcope-dev, in build/release/packages.
packages: deps
	@./scripts/install-deps dpkg-dev file
	@mkdir -p build
	@cmake --preset release > build/release.log 2>&1 || { cat build/release.log; exit 1; }
	cmake --build build/release -j $(JOBS) --target program
	cd build/release && cpack -G DEB

SETS := $(addprefix datasets/,$(addsuffix .yaml,five-cups five-fittings three-airplanes psb-cups psb-airplanes \
  real-fittings raw-fittings resolution noise random-cups random-fittings random-airplanes))
BASELINE_SETS := $(addprefix datasets/,$(addsuffix .yaml,five-cups five-fittings three-airplanes psb-cups psb-airplanes))
# How good it is, from nothing; then the dissertation's pipeline and models on the same sets, as far as it has them.
evaluate: configure
	cmake --build $(BUILD) -j $(JOBS) --target program
	$(TOPOSCOPE) evaluate $(SETS) --out evaluation
	for set in $(BASELINE_SETS); do \
	  $(TOPOSCOPE) evaluate $$set --pipeline neal-1999 --model neal-1999/$$(sed -n 's/^model: //p' $$set) \
	    --out evaluation/neal-1999/$$(basename $$set .yaml) || exit 1; \
	done

# Reports of three generated objects, in headless Chromium, and what `toposcope render` draws of them.
screenshots: configure
	cmake --build $(BUILD) -j $(JOBS) --target program
	@mkdir -p build/screenshots
	for object in cup:cup airplane:airplane tee:pipe-fitting; do \
	  kind=$${object%:*}; \
	  $(TOPOSCOPE) sample $$kind --faces 20000 -o build/screenshots/$$kind.ply && \
	  $(TOPOSCOPE) run build/screenshots/$$kind.ply --model $${object#*:} --out build/screenshots -q || exit 1; \
	done
	cd $(BUILD)/web && node test/screenshots.mjs $(CURDIR)/docs/images \
	  $(foreach kind,cup airplane tee,$(kind)=$(CURDIR)/build/screenshots/$(kind)/report.html)
	TOPOSCOPE=$(TOPOSCOPE) ./scripts/pictures

# Speed beside other libraries; CGAL and VTK take part when libcgal-dev and libvtk9-dev are installed.
bench: deps
	@./scripts/install-deps libbenchmark-dev libpng-dev
	@mkdir -p build
	@cmake --preset release -DTOPOSCOPE_BENCH=ON > build/bench.log 2>&1 || { cat build/bench.log; exit 1; }
	cmake --build build/release -j $(JOBS) --target bench program
	build/release/bin/bench

failing: configure
	cmake --build $(BUILD) -j $(JOBS) --target program fail_nth
	./tests/failing/run.py $(TOPOSCOPE) $(BUILD)/tests/libfail_nth.so

FUZZ_SECONDS ?= 600
# Findings are left in build/fuzz/findings; the fuzzer says how to repeat one.
fuzz: deps
	@./scripts/install-deps clang-14 libclang-rt-14-dev
	@mkdir -p build
	@cmake --preset fuzz > build/fuzz.log 2>&1 || { cat build/fuzz.log; exit 1; }
	cmake --build build/fuzz -j $(JOBS) --target fuzz
	@mkdir -p build/fuzz/findings
	build/fuzz/bin/make_corpus build/fuzz/seeds $(CURDIR)
	@set -e; for format in $(or $(FUZZ),$$(cat build/fuzz/formats)); do \
	  mkdir -p build/fuzz/corpus/$$format; \
	  words=; if test -e build/fuzz/seeds/$$format.dict; then words=-dict=build/fuzz/seeds/$$format.dict; fi; \
	  echo "fuzz_$$format, $(FUZZ_SECONDS) s"; \
	  build/fuzz/bin/fuzz_$$format -max_total_time=$(FUZZ_SECONDS) -rss_limit_mb=512 -timeout=5 -max_len=16384 \
	    -print_final_stats=1 -verbosity=0 -artifact_prefix=build/fuzz/findings/$$format- $$words \
	    build/fuzz/corpus/$$format build/fuzz/seeds/$$format; \
	done

format:
	git ls-files '*.cpp' '*.h' | xargs clang-format -i

# What of lint takes seconds: formatting, the licence on top of every source, scripts that parse.
style: deps
	git ls-files '*.cpp' '*.h' | xargs clang-format --dry-run -Werror
	@! git ls-files '*.cpp' '*.h' '*.cmake' '*CMakeLists.txt' '*.py' 'tests/*.ts' 'web/*.ts' | \
	  xargs grep -L 'SPDX-License-Identifier' | grep . || { echo 'the SPDX line is missing in these'; exit 1; }
	git ls-files '*.py' | xargs python3 -c 'import ast, sys; [ast.parse(open(f).read(), f) for f in sys.argv[1:]]'
	git ls-files scripts .ci | xargs grep -lE '^#!.*\b(ba)?sh$$' | xargs -n 1 bash -n

# Style, and clang-tidy, which cannot read GCC's precompiled headers.
lint: style
	@mkdir -p build
	@cmake --preset lint > build/lint.log 2>&1 || { cat build/lint.log; exit 1; }
	./scripts/lint -j $(JOBS)

clean:
	rm -rf build demo evaluation
