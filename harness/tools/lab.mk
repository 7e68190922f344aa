# The laboratory: make lab lists it, make lab L="NAME ..." runs it. What the report draws is left beside the results, all else in $(LAB).
LAB := $(BUILD)/lab
LABS := $(shell sed -n 's/^lab-\([a-z-]*\):.*## .*/\1/p' harness/tools/lab.mk)
$(if $(filter-out $(LABS),$(L)),$(error make lab: there is no $(filter-out $(LABS),$(L)); 'make lab' lists what there is))
ifeq ($(MAKELEVEL),0)
$(call in_order,$(L:%=lab-%))
endif

.PHONY: lab $(LABS:%=lab-%)
lab: $(L:%=lab-%)
	@$(if $(L),:,awk -F':.*## ' '/^lab-[a-z-]+:.*## /{printf "make lab L=%-17s %s\n", substr($$1, 5), $$2}' harness/tools/lab.mk)

lab-bench-check: all ## inject delays of known size, which comparisons must detect, and nothing else; 2 minutes; build/bench_check.json
	@$(PYTHON) harness/tools/bench_check.py $(PROGRAM) -o $(BUILD)/bench_check.json

ELEMENT_TIME := $(BUILD)/harness/model/test/element_time
lab-bench-elements: all $(ELEMENT_TIME) ## measure microseconds per element for every formulation; seconds; a table
	@$(ELEMENT_TIME)

$(ELEMENT_TIME): $(ELEMENT_TIME).o $(KIT) $(LIBRARY)
	@$(CC) $(CFLAGS) -o $@ $^ $(LDFLAGS) $(DEP_LIBS)

lab-bench-mechanisms: all ## measure the spherical joint and the hexapod: time over the number of elements, parts of an iteration, dense algorithm; a minute; build/mechanisms_*.h5
	@$(PROGRAM) bench spherical_joint -f sheet_third -f sheet_second -f collocation -n 1,2,4,8,16,32 --dense -o $(BUILD)/mechanisms_joint.h5
	@$(PROGRAM) bench hexapod -f sheet_third -f sheet_second -f collocation -n 1,2 --dense -o $(BUILD)/mechanisms_hexapod.h5

lab-blind-spots: verify $(PLANTED) ## measure the smallest fault in each stiffness, mass and load that verify detects, for each quantity and formulation; 10 minutes; harness/blind_spots.csv, harness/planted_faults.csv
	@BEAMWORK_TRUTHS=$(TRUTHS) $(PYTHON) harness/tools/blind_spots.py $(PLANTED) $(BUILD)/verify.json $(BUILD)/results.h5 reference/findings.csv -o harness/blind_spots.csv -p harness/planted_faults.csv

lab-causes: all ## compare the errors allowed by the known deviations with the observed errors; experiments on the causes; 10 minutes; build/causes.json
	@test -f $(BUILD)/verify.json || $(MAKE) --no-print-directory verify
	@$(PYTHON) harness/tools/causes.py $(PROGRAM) $(BUILD)/verify.json -o $(BUILD)/causes.json
	@$(PYTHON) harness/tools/bounds.py $(BUILD)/verify.json reference/findings.csv

# Status 1: an interface requirement is violated; the report says which.
lab-certificates: all ## check every formulation against the interface requirements, and measure what a paper should report; a second; its part of build/results.h5
	@$(PROGRAM) element-test all -o $(BUILD)/results.h5 || [ $$? = 1 ]

lab-run-cost: verify needs-report ## fit the expected cost of cells to the counted work of verify; 2 minutes; harness/study/run_cost.csv
	@$(PYTHON) -B -m harness.tools.run_cost $(BUILD)/results.h5 -o harness/study/run_cost.csv

lab-faults: ## inject the physical faults of harness/tools/faults.csv one by one; each must be detected; 20 minutes; build/faults.json
	@mkdir -p $(BUILD) && $(PYTHON) harness/tools/mutate.py --physics >$(BUILD)/faults.list
	@LIST=$(BUILD)/faults.list harness/tools/mutants.sh $(BUILD)/faults

lab-film: all needs-report ## write a motion of RESULTS=FILE.h5 (CASE=NAME if there are several) as one HTML file that any browser plays; seconds; build/lab/film_FILE.html
	@test -n "$(RESULTS)" || { echo "make lab L=film: give RESULTS=FILE.h5, of 'beamwork solve CASE --shapes -o FILE.h5'" >&2; exit 2; }
	@mkdir -p $(LAB)
	@PYTHONDONTWRITEBYTECODE=1 $(PYTHON) -m reports "$(RESULTS)" $(TRUTHS) --film $(LAB)/film_$(basename $(notdir $(RESULTS))).html $(if $(CASE),-k "$(CASE)")

lab-vtk: all needs-report ## write the shapes of RESULTS=FILE.h5 as a series of .vtu files for any version of ParaView; seconds; build/lab/FILE.pvd
	@test -n "$(RESULTS)" || { echo "make lab L=vtk: give RESULTS=FILE.h5, of 'beamwork solve CASE --shapes -o FILE.h5'" >&2; exit 2; }
	@mkdir -p $(LAB)
	@PYTHONDONTWRITEBYTECODE=1 $(PYTHON) -m reports "$(RESULTS)" $(TRUTHS) --vtk $(LAB)/$(basename $(notdir $(RESULTS))).pvd

lab-fuzz: all ## pass random bytes to every reader of the program (clang's libFuzzer); 20 minutes; build/fuzz.json
	@harness/tools/fuzz.sh $(BUILD)

lab-instructions: all ## count the instructions of the parts of a solution, compared with the smallest conceivable numbers; requires valgrind; minutes; build/lab/instructions.json
	@mkdir -p $(LAB) && $(PYTHON) harness/tools/instructions.py $(PROGRAM) -o $(LAB)/instructions.json

lab-motions: needs-truths all ## compare every stored value of motions with limits of meshes, at all times; MOTIONS=--fine: finer meshes, which takes longer; 2 minutes; build/lab/motions.csv
	@mkdir -p $(LAB) && $(PYTHON) harness/tools/motions.py $(PROGRAM) $(MOTIONS) -o $(LAB)/motions.csv

lab-mutants: ## inject generated faults of one edit in a fixed sample of all sources; MUTANTS=HEAD~1..: on lines that commits changed, MUTANTS='--count 500': more faults; an hour; build/lab/mutants.json
	@mkdir -p $(LAB) && $(PYTHON) harness/tools/mutate.py $(MUTANTS) >$(LAB)/mutants.list
	@LIST=$(LAB)/mutants.list harness/tools/mutants.sh $(LAB)/mutants

lab-newton: all ## compare the two forms of Newton's method; 20 seconds; build/newton.json
	@$(PYTHON) harness/tools/newton.py $(PROGRAM) -o $(BUILD)/newton.json

lab-integrators: all ## run the integrators on all cases with motions, with all formulations; check the reference with another integrator; a minute; build/integrators.json
	@$(PYTHON) harness/tools/integrators.py $(PROGRAM) -o $(BUILD)/integrators.json $(INTEGRATORS)

lab-cost-coefficients: all needs-report ## fit the cost coefficients of counted work to measured times on an idle machine, and measure their accuracy by kind of analysis; 25 minutes; harness/study/cost_coefficients.csv
	@$(PYTHON) harness/tools/cost_coefficients.py $(PROGRAM) -o harness/study/cost_coefficients.csv

lab-times: verify ## measure the times that docs/howto/speed.md states, on an idle machine; TIMES=--write: write them into the page; 20 minutes; build/lab/times.json
	@mkdir -p $(LAB) && $(PYTHON) harness/tools/times.py $(PROGRAM) $(TIMES) -o $(LAB)/times.json

lab-valgrind: all ## run a small selection of verify, and a thousand cycles of the library, under valgrind; 10 minutes
	@harness/tools/valgrind.sh $(BUILD)
