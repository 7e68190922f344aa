#include "harness/cli/option_table.h"

#include "harness/cli/command.h"

const verb_option option_table[OPTION_MOST] = {
    {"formulation", 'f', "NAME[:KEY=VALUE,...]",
     "formulation and its options; again for another, 'all' for every one", 0},
    {"element", 'x', "FILE|exec:COMMAND",
     "a formulation of your own: a shared object (with a '/': ./mine.so), or a command that speaks "
     "the protocol of harness/formulations/protocol.md ('exec:python3 my_beam.py'); again for "
     "another",
     0},
    {"elements", 'n', "N[,N...]",
     "elements per member; of each piece where loads begin, end or act within it", 0},
    {"set", 's', "NAME=VALUE", "value of a case parameter (SI); again for another", 0},
    {"format", 'F', "text|json|csv", "form of the output (default text)", 0},
    {"output", 'o', "FILE", "write there instead of to standard output (verify: results as HDF5)",
     offsetof(command_request, output)},
    {"keep-all", 'K', NULL, "leave nothing out: same answer, more work",
     offsetof(command_request, keep_all)},
    {"steps", 'S', "N",
     "load steps between two stations of a path, to begin with; longer where that goes well", 0},
    {"select", 'k', "EXPRESSION",
     "words joined by and, or, not, in brackets where they belong together; looked for in "
     "case/parameters/formulation/quantity, where a part of a name is enough; =NAME: the whole "
     "name",
     offsetof(command_request, select)},
    {"jobs", 'j', "N", "processes (default: one for each processor)", 0},
    {"time-limit", 'L', "SECONDS",
     "of one cell (default 120; element-test: 60, of one part; 0: none); a cell that exceeds it is "
     "a failure of that name",
     0},
    {"json", 'J', "FILE", "verdicts as JSON", offsetof(command_request, json)},
    {"junit", 'U', "FILE", "verdicts as JUnit XML", offsetof(command_request, junit)},
    {"threshold", 'c', "NAME=R[,NAME=R]",
     "changes that count (default error=0.01,floor=1e-8,work=0.02): of an error relative to "
     "itself, of a value relative to its truth, of a count relative to itself",
     offsetof(command_request, threshold)},
    {"shapes", 'P', "STATES",
     "store centre lines, sections and resultants of at most so many states of a path (solve: all, "
     "and -o FILE becomes HDF5 for ParaView; verify: 5), and as many frames of a motion, evenly "
     "over "
     "its time (60 where it is left out or at most 5)",
     0},
    {"follow", 'V', "NAME=A..B/N",
     "modes over a parameter, in N equal parts or smaller ones: matched by their shapes, so that "
     "those that cross keep their number",
     offsetof(command_request, follow)},
    {"vary", 'y', "NAME=A..B/N|A,B,C",
     "what the sweep is over: N equal parts (N + 1 values), with ':log' behind equal ratios; a "
     "list "
     "of values or words; again for another parameter",
     0},
    {"design", 'd', "grid|sobol|halton|random",
     "points of the sweep: all of the grid (default), or --points N that fill the box of "
     "--vary NAME=A..B",
     offsetof(command_request, design)},
    {"points", 'z', "N", "how many points a design has that is no grid", 0},
    {"seed", 'r', "S", "of --design random (default 1)", 0},
    {"derive", 'g', NULL,
     "solve for truths where none is stored: about half a second for each point (a scene: 4 s)",
     offsetof(command_request, derive)},
    {"matrices", 'R', "FOLDER",
     "also stiffness, mass and gyroscopic matrices about every state, as Matrix Market, with a "
     "table "
     "of their rows, into a new folder",
     offsetof(command_request, matrices)},
    {"ends", '4', "FILE",
     "also keep where motions in time stop (HDF5): --restart goes on from there",
     offsetof(command_request, ends)},
    {"restart", '5', "FILE",
     "go on from where the motions of another run stopped, kept by its --ends: the same scene with "
     "later stations, with the bits of one run where steps stay and end there",
     offsetof(command_request, restart)},
    {"markdown", 'M', "FILE", "summary as Markdown, for a pull request",
     offsetof(command_request, markdown)},
    {"against", 'A', "OTHER",
     "compare in alternation with another formulation (without -n: at equal error), or with "
     "another "
     "program (a path with a '/': at equal n)",
     offsetof(command_request, against)},
    {"error", 'e', "R[,R...]",
     "converge, sweep: error that is asked for (default 1%); solve: change from mesh to mesh "
     "that counts as none (default 0.1%); bench --against: errors at which to compare, such as "
     "1%,0.1% (default: those of 10, 1, 0.1 and 0.01 % that both reach)",
     offsetof(command_request, error)},
    {"threads", 't', "N",
     "threads that share the loop over elements (default 1); results are the same", 0},
    {"dense", 'D', NULL, "time the published algorithm (newton=dense) beside every cell",
     offsetof(command_request, dense)},
    {"plant", 'X', "PERCENT",
     "make the other slower by that much, to see whether the comparison finds it", 0},
    {"truths", 'T', "FILE",
     "packed truths (default: $BEAMWORK_TRUTHS, or truths.h5 beside the program); "
     "verify, solve, converge, bench and truth also take a FILE.csv: truths of your own beside "
     "them, again for another",
     0},
    {"findings", 'W', "FILE.csv", "findings of your own beside the ledger; again for another", 0},
    {"scene", 'Y', "FILE",
     "a scene of your own in YAML, in the place of a case (verify: or a folder of them; again for "
     "another)",
     0},
    {"built-in", 'I', NULL, "the built-in cases beside those of --scene",
     offsetof(command_request, built_in)},
    {"beside", 'B', "FILE",
     "what other programs found, stored by 'beamwork import': contestants that gate nothing; again "
     "for another file",
     0},
    {"map", 'm', "FILE.yaml", "which columns of files without a header are which quantities",
     offsetof(command_request, map)},
    {"doublings", 'N', "N",
     "so many more meshes of each series, each of twice the elements: do the verdicts stand?", 0},
    {"exit-zero", '0', NULL,
     "explore: exit status 0 whatever the verdicts are; files say how it ended as ever",
     offsetof(command_request, exit_zero)},
    {"tolerance", '6', "R",
     "limits within R (1% or 0.01) of the reference value pass: in place of the tolerances of the "
     "cases, and whatever their order",
     offsetof(command_request, tolerance)},
    {"not-worse-than", '7', "FILE",
     "results of a former 'verify -o', or the short table of them that 'compare FILE -o' writes: "
     "fail where the error of any mesh is larger than there by more than 2 %, its value is gone, "
     "or "
     "a limit has moved by more than 0.001 % that no exact value judges as closely",
     offsetof(command_request, former)},
    {"gate", 'G', NULL, "verdicts of --beside count as ours do", offsetof(command_request, gate)},
    {"to", 'O', "calculix", "the program that the deck is for", offsetof(command_request, to)},
    {"schema", 'H', NULL, "describe all keys of scene files as JSON Schema",
     offsetof(command_request, schema)},
    {"keys", 'E', NULL, "list all keys of scene files", offsetof(command_request, keys)},
    {"shard", 'Z', "K/N",
     "compute the K-th of N shards only, each batch into a file below --into; started again, what "
     "is missing",
     offsetof(command_request, shard)},
    {"into", 'i', "FOLDER", "of the batches of --shard (without it: of all); it is made",
     offsetof(command_request, into)},
    {"plan", 'C', "N",
     "when would 1, 2, 4, ..., N shards end? Nothing is computed; with --into by what the batches "
     "of that folder took",
     0},
    {"from", 'b', "FOLDER",
     "take the batches that are there instead of computing, as 'beamwork merge' does; again for "
     "another",
     0},
    {"partial", 'w', NULL, "go on without the batches that are missing",
     offsetof(command_request, partial)},
    {"hash", 'Q', NULL, "one line for each run: a hash of its values, how many they are, its name",
     offsetof(command_request, hash)},
    {"propose", 'p', "FILE",
     "findings that new formulations would need, as rows for a ledger (CSV)",
     offsetof(command_request, propose)},
    {"integrator", 'u', "NAME[,NAME...]",
     "alpha, alpha:rho=R, hht, hht:alpha=A, trapezoidal, conserving, radau, explicit (default: "
     "six of them)",
     offsetof(command_request, integrators)},
    {"step", 'a', "H[,H...]|H..H",
     "steps of integration [s]; a range is halved from the first to the last (default: 2, 1, 1/2 "
     "and 1/4 of that of the motion)",
     offsetof(command_request, step_lengths)},
    {"tolerance", 'l', "R[,R...]|R..R",
     "errors of a step by which it is chosen, of integrators that estimate it; a range goes by "
     "hundredths",
     offsetof(command_request, tolerances)},
    {"no-errors", '3', NULL,
     "no reference is computed, and no step is halved: energy and momenta alone",
     offsetof(command_request, no_errors)},
    {"expected", '1', "FILE.csv", "verdicts that are expected, in the place of a case",
     offsetof(command_request, expected)},
    {"verbose", 'v', NULL,
     "verify: every limit, not only the overview; converge: values, times and limits of each "
     "formulation by itself; motion --expected: every motion",
     offsetof(command_request, verbose)},
    {"quiet", 'q', NULL, "only what is unexpected, and the last sentence",
     offsetof(command_request, quiet)},
    {"help", KEY_HELP, NULL, "this list", 0},
    {"usage", KEY_USAGE, NULL, "the options in short", 0},
    {0},
};
