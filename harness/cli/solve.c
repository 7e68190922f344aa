#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "harness/cli/cli.h"
#include "harness/experiments/experiments.h"
#include "harness/formulations/formulations.h"
#include "harness/records/records.h"
#include "harness/terminal/terminal.h"

typedef struct solve_request {
    case_options of;
    chosen_formulations chosen;
    mesh_list meshes;
    truths_options truths;
    solver_options solver;
    const char *select, *output, *format;
    double error;
    int steps;
    int shapes;         /* number of states of a path whose shapes are stored; 0: none */
    const char *follow; /* NAME=A..B/N: parameter over which modes are followed; NULL: none */
    const char *matrices;
    int state_space;    /* 1: linear models are written as well */
    const char *reduce; /* reduced models that are also written; NULL: none */
    /* ends: file for the final states of motions; restart: file with the states from which motions
     * continue */
    const char *ends, *restart;
} solve_request;

typedef struct solve_work {
    solution_request what;
    solution_choice why;
    char note[DEFAULTS_NOTE];
    restart from;
    sweep s;
    truths t;
} solve_work;

static void work_free(solve_work *w)
{
    sweep_free(&w->s);
    truths_free(&w->t);
    restart_free(&w->from);
    solution_choice_free(&w->why);
}

static defaults defaults_of(solve_request *r, const case_type *type)
{
    return (defaults){.wanted = {.type = type,
                                 .parameter = r->of.parameter,
                                 .select = r->select,
                                 .keep_all = r->solver.keep_all,
                                 .steps = r->steps,
                                 .shapes = r->shapes,
                                 .threads = r->solver.threads,
                                 .error = r->error,
                                 .systems = r->matrices != NULL ? 1 + r->state_space : 0,
                                 .reduce = r->reduce},
                      .chosen = &r->chosen,
                      .meshes = &r->meshes,
                      .truths = &r->truths};
}

static status write_to(FILE *to, const solve_request *r, const char *note, const sweep *s,
                       const truths *t, fault *f)
{
    if (strcmp(r->format, "json") == 0)
        return json_write_solution(to, s, t, f);
    if (strcmp(r->format, "csv") == 0)
        csv_solution(to, s);
    else {
        fputs(note, to);
        table_solution(to, s, t);
    }
    return STATUS_OK;
}

static status write_out(const solve_request *r, const char *note, const sweep *s, const truths *t,
                        fault *f)
{
    output file;
    if (r->shapes > 0) {
        const environment e = environment_now(1);
        fputs(note, stdout);
        table_solution(stdout, s, t);
        TRY(store_write_solution(r->output, s, &e, f));
        return output_flush(f);
    }
    TRY(output_open(r->output, &file, f));
    return output_finish(&file, write_to(file.stream, r, note, s, t, f), f);
}

static void report_close_frequencies(const scene *s, const state_matrices *m)
{
    if (m->model.apart > 0)
        fprintf(stderr,
                "beamwork: state space of %s: the mass inside elements (M_inside) is omitted; the "
                "responses differ by at most %.1e of the largest response (%s); use more elements, "
                "or 'mass: lumped', which has no mass inside elements\n",
                scene_name(s, SCENE_ANALYSES, m->analysis).text, m->model.apart,
                s->quantity[m->model.farthest].name);
}

static void report_reduced_transfer(const system_matrices *all, const reduced_model *r)
{
    double apart = 0;
    int largest = 0, zeros = 0;
    const int functions = all->outputs * all->inputs;
    if (r->apart == NULL || functions == 0)
        return;
    for (int k = 0; k < functions; k++) {
        zeros += isnan(r->apart[k]);
        if (r->apart[k] > apart) {
            apart = r->apart[k];
            largest = k;
        }
    }
    if (zeros < functions)
        fprintf(stderr,
                "; transfer functions differ by at most %.1e of the largest (output %d, input %d)",
                apart, largest / all->inputs + 1, largest % all->inputs + 1);
    if (zeros > 0)
        fprintf(stderr, "; %d of %d transfer functions are zero and not counted", zeros, functions);
}

static void report_reduced(const scene *s, const system_matrices *all, const state_matrices *m)
{
    const reduced_model *r = &m->reduced;
    double frequency = 0;
    if (r->T.rows == 0)
        return;
    for (int i = 0; i < r->modes; i++)
        frequency = fmax(frequency, fabs(r->reduced[i] / r->whole[i] - 1));
    fprintf(stderr, "beamwork: reduced model of %s: %d of %d coordinates; ",
            m->analysis == SCENE_NONE ? "the undeformed structure"
                                      : scene_name(s, SCENE_ANALYSES, m->analysis).text,
            r->T.columns, r->T.rows);
    if (r->taken > r->requested)
        fprintf(stderr,
                "%d modes instead of %d, so that modes with the same frequency stay together; ",
                r->taken, r->requested);
    if (r->modes > 0)
        fprintf(stderr, "natural frequencies: %d compared, relative errors at most %.1e", r->modes,
                frequency);
    else
        fputs("natural frequencies were not compared, because there are no modes or the structure "
              "is free to move",
              stderr);
    report_reduced_transfer(all, r);
    fprintf(stderr, "\n");
}

static void report_loops(const scene *s, const system_matrices *of)
{
    int closed = 0;
    for (int i = 0; i < of->states; i++)
        closed |= of->state[i].model.loops > 0;
    for (int i = 0; i < s->loads; i++)
        if (s->load[i].feedback.node != SCENE_NONE)
            fprintf(stderr,
                    "beamwork: matrices: the feedback loop of %s is open, so the load is an input "
                    "and no matrix contains its gains%s\n",
                    scene_called(s, SCENE_LOADS, i).text,
                    closed ? " except those in state_space of harmonic analyses" : "");
}

static status write_matrices(const solve_request *r, const sweep *s, fault *f)
{
    const cell_result *cell = &s->series[0].cell[0];
    char title[256];
    if (r->matrices == NULL || cell->solve.systems.label == NULL) /* already reported */
        return STATUS_OK;
    snprintf(title, sizeof title, "%s, %s, elements per member: %d", s->point[0].scene.name,
             r->chosen.formulation[0].key, r->meshes.elements[0]);
    report_loops(&s->point[0].scene, &cell->solve.systems);
    TRY(system_folder_write(r->matrices, title, &s->point[0].scene, &cell->solve.systems, f));
    for (int i = 0; i < cell->solve.systems.states; i++) {
        report_close_frequencies(&s->point[0].scene, &cell->solve.systems.state[i]);
        report_reduced(&s->point[0].scene, &cell->solve.systems, &cell->solve.systems.state[i]);
    }
    return STATUS_OK;
}

/* Reads the value NAME=A..B/N of --follow. Both ends must be allowed values of the parameter. */
static status range_of(const solve_request *r, const case_type *type, follow_request *out, fault *f)
{
    const char *ends = strchr(r->follow, '='), *dots = ends != NULL ? strstr(ends, "..") : NULL,
               *slash = dots != NULL ? strchr(dots, '/') : NULL;
    const assignment_list list = parameters_list(type);
    double value[CASE_MAX_PARAMETERS];
    char text[160];
    int used = 0;
    if (slash == NULL || sscanf(slash + 1, "%d%n", &out->parts, &used) != 1 ||
        slash[1 + used] != '\0' || out->parts < 1 || out->parts > 100000)
        return fault_set(f, STATUS_REFUSED,
                         "--follow '%.60s' is not valid; give NAME=A..B/N with N from 1 to 100000, "
                         "such as width=0.01..0.03/20",
                         r->follow);
    memcpy(value, r->of.parameter, sizeof value);
    snprintf(text, sizeof text, "%.*s", (int)(dots - r->follow), r->follow);
    TRY(assignment_set(&list, text, value, NULL, &out->parameter, f));
    out->from = value[out->parameter];
    snprintf(text, sizeof text, "%.*s%.*s", (int)(ends + 1 - r->follow), r->follow,
             (int)(slash - dots - 2), dots + 2);
    TRY(assignment_set(&list, text, value, NULL, &out->parameter, f));
    out->to = value[out->parameter];
    return fabs(out->to - out->from) > 0
               ? STATUS_OK
               : fault_set(f, STATUS_REFUSED,
                           "--follow '%.60s': both ends are the same; give two different values",
                           r->follow);
}

static status write_curves(const solve_request *r, const char *note, const char *name,
                           const follow_curves *c, fault *f)
{
    output file;
    status written = STATUS_OK;
    TRY(output_open(r->output, &file, f));
    if (strcmp(r->format, "json") == 0)
        written = follow_record_json(file.stream, name, c, f);
    else if (strcmp(r->format, "csv") == 0)
        follow_record_csv(file.stream, name, c);
    else {
        fputs(note, file.stream);
        table_follow(file.stream, name, c);
    }
    return output_finish(&file, written, f);
}

static status follow_modes(solve_request *r, const case_type *type, fault *f)
{
    char name[SCENE_NAME], note[DEFAULTS_NOTE];
    follow_curves curves;
    follow_request what = {
        .cell = {.type = type, .keep_all = r->solver.keep_all, .threads = r->solver.threads}};
    if (r->shapes > 0 || r->matrices != NULL || r->ends != NULL || r->restart != NULL ||
        r->select != NULL)
        return fault_set(f, STATUS_REFUSED,
                         "--follow computes only curves of modes; remove -k, --shapes, --matrices, "
                         "--save-state and --restart");
    TRY(range_of(r, type, &what, f));
    snprintf(name, sizeof name, "%.*s", (int)strcspn(r->follow, "="), r->follow);
    TRY(files_check(r->of.line, 0, user_tables_packed(&r->truths), f));
    const defaults missing = defaults_of(r, type);
    TRY(defaults_fill(&missing, note, NULL, f));
    cell_formulation(&what.cell, &r->chosen.formulation[0]);
    what.cell.elements = r->meshes.elements[0];
    what.cell.solve.steps_between = r->steps;
    memcpy(what.cell.parameter, r->of.parameter, sizeof what.cell.parameter);
    TRY(follow_run(&what, &curves, f));
    const status written = write_curves(r, note, name, &curves, f);
    follow_free(&curves);
    return written;
}

static status take_restart(solve_request *r, restart *from, fault *f)
{
    TRY(restart_read(r->restart, from, f));
    if (r->chosen.formulations == 0)
        TRY(formulation_parse(from->formulation, &r->chosen.formulation[r->chosen.formulations++],
                              f));
    if (r->meshes.count == 0)
        r->meshes.elements[r->meshes.count++] = from->elements;
    return STATUS_OK;
}

static status prepare_ends(const solve_request *r, restart *from, solution_request *what, scene *s,
                           fault *f)
{
    what->keep_ends = r->ends != NULL;
    if (r->ends != NULL || r->restart != NULL)
        TRY(restart_possible(s, f));
    return r->restart != NULL ? restart_begin(from, what, s, f) : STATUS_OK;
}

static status prepare(solve_request *r, const case_type *type, solve_work *w, fault *f)
{
    if (r->error > 0 && (r->meshes.count > 0 || r->restart != NULL))
        return fault_set(f, STATUS_REFUSED,
                         "--error lets beamwork choose the mesh; remove --error, or %s",
                         r->meshes.count > 0 ? "-n" : "--restart");
    if (r->state_space && r->matrices == NULL)
        return fault_set(
            f, STATUS_REFUSED,
            "--state-space adds files to those of --matrices; add, for example, --matrices folder");
    if (r->reduce != NULL && !r->state_space)
        return fault_set(f, STATUS_REFUSED,
                         "--reduce reduces the model of --state-space; add --state-space");
    TRY(files_check(r->of.line, r->shapes > 0, user_tables_packed(&r->truths), f));
    const status known = case_input_truths(&r->of, &r->truths, &w->t, f);
    if (known != STATUS_OK && r->truths.packed == NULL && r->of.scene == NULL)
        fprintf(stderr, "beamwork: no reference values are used: %s\n", f->text);
    else
        TRY(known);
    if (r->restart != NULL)
        TRY(take_restart(r, &w->from, f));
    defaults missing = defaults_of(r, type);
    missing.known = &w->t;
    TRY(defaults_fill(&missing, w->note, &w->why, f));
    w->what = defaults_request(&missing);
    TRY(solution_plan(&w->what, &w->s, f));
    return prepare_ends(r, &w->from, &w->what, &w->s.point[0].scene, f);
}

static status write_ends(const solve_request *r, const solution_request *what, const sweep *s,
                         fault *f)
{
    if (r->ends == NULL)
        return STATUS_OK;
    if (s->series[0].cell[0].solve.ends > 0)
        return restart_write(r->ends, what, s, f);
    fprintf(stderr,
            "beamwork: no motion reached its end, so --save-state %s is not written; the status "
            "gives the reason\n",
            r->ends);
    return STATUS_OK;
}

static status write_all(const solve_request *r, const solve_work *w, fault *f)
{
    TRY(write_out(r, w->note, &w->s, &w->t, f));
    TRY(write_ends(r, &w->what, &w->s, f));
    return write_matrices(r, &w->s, f);
}

/* Prints the failure of the run or, after a complete run, the reason for the first missing value,
 * and returns the exit status. If the mesh has no such mode or the path no such point, the missing
 * value counts as a result. */
static int report_missing(status solved, const cell_result *cell, const fault *f)
{
    const int refused = cell_values(cell) > 0 && solved == STATUS_REFUSED;
    for (int i = 0; solved == STATUS_OK && i < cell->solve.quantities; i++) {
        const quantity_result *q = &cell->solve.quantity[i];
        if (q->status != STATUS_OK && q->status != STATUS_NO_VALUE)
            return message_fail(q->status == STATUS_FAULT ? STATUS_FAULT : STATUS_NO_VALUE,
                                q->reason);
    }
    return refused ? message_fail(STATUS_NO_VALUE, f->text) : message_exit(solved, f);
}

static void report_large(const scene *s, const solve_result *r)
{
    const double size = change_size(s);
    for (int i = 0; i < r->quantities; i++) {
        const scene_quantity *q = &s->quantity[i];
        const double moved = fabs((r->quantity[i].value - q->offset) / q->factor);
        if (q->what.kind != SCENE_COORDINATE || scene_component_of(q)->component >= SCENE_RX ||
            s->analysis[q->analysis].kind != SCENE_LINEAR || q->reduction == SCENE_CURVE ||
            r->quantity[i].status != STATUS_OK || !(moved > size && size > 0))
            continue;
        fprintf(stderr,
                "beamwork: warning: %s: a linear analysis gives a displacement of %.3g times the "
                "size of the structure; check units, loads and supports\n",
                q->name, moved / size);
        return;
    }
}

static int solve_and_write(const solve_request *r, solve_work *w)
{
    fault f = {""}, unwritten = {""};
    const scene *s = &w->s.point[0].scene;
    case_input_report_analysis(&r->of, s);
    formulation_start_guard(&w->what.formulation, r->chosen.time_limit);
    const status solved = solution_run(&w->what, &w->why, &w->s, &f);
    const cell_result *cell = &w->s.series[0].cell[0];
    if (solved == STATUS_FAULT || (solved == STATUS_REFUSED && cell_values(cell) == 0))
        return message_fail(solved, f.text);
    report_large(s, &cell->solve);
    const status written = write_all(r, w, &unwritten);
    return written != STATUS_OK ? message_fail(written, unwritten.text)
                                : report_missing(solved, cell, &f);
}

static int answer(const command_line *l, void *request)
{
    solve_request *r = request;
    (void)l;
    fault f = {""};
    const case_type *type = case_input_find(&r->of);
    if (type == NULL)
        return r->of.refusal;
    if (r->chosen.formulations > 1 || r->meshes.count > 1)
        return message_fail(STATUS_REFUSED,
                            "solve accepts one formulation and one mesh; give one -f and one "
                            "number with -n, or use 'beamwork converge'");
    if (r->follow != NULL)
        return message_exit(follow_modes(r, type, &f), &f);
    if (r->shapes > 0 && r->output == NULL)
        return message_fail(STATUS_REFUSED,
                            "--shapes requires a file; add, for example, -o shapes.h5");
    solve_work w = {.from = {.ends = 0}};
    const status ready = prepare(r, type, &w, &f);
    const int code = ready == STATUS_OK ? solve_and_write(r, &w) : message_fail(ready, f.text);
    work_free(&w);
    return code;
}

#define IN(at) .member = offsetof(solve_request, at)
static const verb_option own[] = {
    {"error", 0, "R", "change between meshes that counts as negligible (default 0.1%)", IN(error),
     .read = option_error},
    {"steps", 0, "N",
     "initial number of load steps between two stations of a path; the step size adapts", IN(steps),
     .least = 1, .most = 1000000},
    {"shapes", 0, "[STATES]",
     "store centre lines, sections and resultants for ParaView (-o FILE is then HDF5), for at most "
     "STATES states of a path (default: all) and STATES frames of a motion, evenly distributed "
     "over time (60 by default, or if STATES is at most 5)",
     IN(shapes), .least = 1, .most = SHAPES_ALL},
    {"follow", 0, "NAME=A..B/N",
     "compute modes over a parameter, in N equal or smaller steps; modes are matched by their "
     "shapes, so modes whose frequencies cross keep their numbers",
     IN(follow)},
    {"matrices", 0, "FOLDER",
     "also write the stiffness, mass and gyroscopic matrices about every state (Matrix Market), "
     "with a table of the rows, to a new folder",
     IN(matrices), .traits = OPTION_OUTPUT | OPTION_FOLDER},
    {"state-space", 0, NULL,
     "with --matrices: also write x' = A x + B u, y = C x + D u about every state, and the same "
     "system in second order; the inputs are forces, motions and loads, the outputs are responses "
     "and displacements",
     IN(state_space)},
    {"reduce", 0, "MODES[:NODE,...]",
     "with --state-space: also write reduced models with this number of modes. With interface "
     "nodes, a model contains the static shapes of these nodes and modes with these nodes fixed "
     "(Craig-Bampton); without nodes, free modes and the static shapes of the forces. The errors "
     "of the models are printed",
     IN(reduce)},
    {"save-state", 0, "FILE",
     "also store the last state of motions (HDF5), from which --restart continues", IN(ends),
     .traits = OPTION_OUTPUT | OPTION_HDF5},
    {"restart", 0, "FILE",
     "continue the motions of another run from its --save-state file; give the same scene with "
     "later stations; with the same steps, the results are those of an uninterrupted run, apart "
     "from rounding; windows must begin at the saved state or later",
     IN(restart), .traits = OPTION_INPUT},
    {0}};
static const verb_group shared[] = {SHARED(case, of),
                                    SHARED(formulations, chosen),
                                    SHARED(meshes, meshes),
                                    SHARED(select, select),
                                    SHARED(time_limit, chosen),
                                    SHARED(solver, solver),
                                    SHARED(user_truths, truths),
                                    SHARED(output, output),
                                    SHARED(format, format),
                                    {NULL, 0}};
const verb verb_solve = {
    "solve",
    "CASE",
    "solves one case with one formulation and one mesh: every quantity with its error",
    "Solves one case with one formulation and one mesh, and prints every quantity with its error. "
    "Without -n, the mesh is refined until no value changes by more than 0.1 % (--error): first "
    "through the meshes of the case, then by doubling, up to 1024 elements or 2 s of counted work. "
    "If values still change, the status is not_converged. Values are printed to the second digit "
    "of their last change between meshes, which is not a bound of their error. Without -f, up to "
    "five formulations are tried, which support the physics of the case and have no known "
    "deviation there. The first one that converges is used, in the order of the cost of the next "
    "mesh; with -n, the one of the highest order is used. The output states the choice and the "
    "reason. Analyses that no quantity uses are not run, unless the scene has no quantities or "
    "their states are drawn or written. -k selects quantities.",
    "beamwork solve elastica\n"
    "beamwork solve c_column -f beamw -n 8 --set section_data=printed\n"
    "beamwork solve c_column -k buckling_load\n"
    "beamwork solve pendulum -f collocation -n 8 --set time=1 --save-state pendulum.h5\n"
    "beamwork solve pendulum --set time=2 --restart pendulum.h5",
    shared,
    own,
    sizeof(solve_request),
    .place = VERB_COMPUTE + 10,
    .answer = answer};
