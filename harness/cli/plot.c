#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/wait.h>
#include <unistd.h>

#include "harness/cli/cli.h"
#include "harness/experiments/experiments.h"
#include "harness/records/records.h"
#include "harness/study/study.h"

typedef struct plot_request {
    case_options of;
    chosen_formulations chosen;
    mesh_list meshes;
    solver_options solver;
    const char *select, *output;
    int steps;
} plot_request;

/* COULD_NOT: exit status of reports/graph.py if nothing can be drawn */
enum { INSTANTS = 300, STATES = 20, COULD_NOT = 4 };

static const char python[] = "/usr/bin/python3";
static const char begin_program[] =
    "import runpy, sys; sys.path.insert(0, sys.argv.pop(1)); "
    "runpy.run_module('reports.graph', run_name='__main__', alter_sys=True)";

static int takes_stations(const scene *s, int analysis)
{
    for (int i = 0; i < s->quantities; i++)
        if (s->quantity[i].analysis == analysis && s->quantity[i].transform != SCENE_HISTORY)
            return 1;
    return 0;
}

/* Replaces the stations of a path by the ends of `parts` equal parts from begin to end. first 0:
 * begin is also a station. */
static status divide(scene_path *path, double begin, double end, int parts, int first, fault *f)
{
    double *more = realloc(path->value, ((size_t)parts + 1) * sizeof *more);
    if (more == NULL)
        return fault_memory(f, "a figure");
    *path = (scene_path){0, more};
    for (int i = first; i < parts; i++)
        more[path->stations++] = begin + i * ((end - begin) / parts);
    more[path->stations++] = end;
    return STATUS_OK;
}

static status read_densely(scene *s, int analysis, fault *f)
{
    scene_analysis *a = &s->analysis[analysis];
    scene_path *path = scene_editable_path(a);
    if (a->kind == SCENE_STATIC && path->stations == 1)
        return divide(path, 0, path->value[0], STATES, 0, f);
    if (a->kind != SCENE_MOTION || path->stations > INSTANTS || takes_stations(s, analysis))
        return STATUS_OK;
    const int later = a->follows != SCENE_NONE && s->analysis[a->follows].kind == SCENE_MOTION;
    const scene_path *before = later ? scene_path_of(&s->analysis[a->follows]) : NULL;
    return divide(path, later ? before->value[before->stations - 1] : 0,
                  path->value[path->stations - 1], INSTANTS, later, f);
}

static status add_phase(scene *s, int quantity, fault *f)
{
    const scene_quantity *q = &s->quantity[quantity];
    scene_extract what = q->what;
    if (what.kind != SCENE_RESPONSE || what.of.response.part != SCENE_AMPLITUDE)
        return STATUS_OK;
    what.of.response.part = SCENE_PHASE;
    for (int i = 0; i < s->quantities; i++)
        if (s->quantity[i].what.kind == SCENE_RESPONSE && s->quantity[i].analysis == q->analysis &&
            memcmp(&s->quantity[i].what.of.response, &what.of.response, sizeof what.of.response) ==
                0)
            return STATUS_OK;
    scene_quantity phase = *q;
    char name[SCENE_NAME];
    snprintf(name, sizeof name, "%.*s, phase", SCENE_NAME - 10, q->name);
    phase.what = what;
    scene_quantity *added = scene_add_quantity(s, name, "rad", phase.analysis, what);
    if (s->out_of_memory)
        return fault_memory(f, "a figure");
    added->acting = phase.acting;
    added->reduction = SCENE_CURVE;
    added->x = phase.x;
    return STATUS_OK;
}

static int can_be_drawn(const scene *s, const scene_quantity *q)
{
    const scene_analysis *a = &s->analysis[q->analysis];
    return !scene_is_timed(q->reduction) &&
           (scene_path_of(a) != NULL || (a->kind == SCENE_COMPLIANCE && a->follows != SCENE_NONE));
}

static int make_curve(scene *s, scene_quantity *q)
{
    fault no;
    const scene_quantity was = *q;
    const scene_analysis_kind kind = s->analysis[q->analysis].kind;
    if (q->reduction == SCENE_CURVE)
        return 1;
    q->passing = (scene_passing){0};
    scene_set_curve(q,
                    kind == SCENE_HARMONIC ? "frequency"
                    : kind == SCENE_MOTION ? "time"
                                           : "path",
                    kind == SCENE_HARMONIC ? "Hz"
                    : kind == SCENE_MOTION ? "s"
                                           : "1",
                    1, 0);
    if (scene_validate(s, &no) == STATUS_OK)
        return 1;
    *q = was;
    return 0;
}

static void drop_envelopes(scene *s)
{
    int kept = 0;
    for (int i = 0; i < s->quantities; i++)
        if (s->quantity[i].what.kind == SCENE_ENVELOPE_OF)
            free(s->quantity[i].over);
        else
            s->quantity[kept++] = s->quantity[i];
    s->quantities = kept;
}

static status make_curves(scene *s, fault *f)
{
    int kept = 0;
    drop_envelopes(s);
    for (int i = 0; i < s->quantities; i++) {
        scene_quantity *q = &s->quantity[i];
        const int drawn = can_be_drawn(s, q) && make_curve(s, q);
        if (!drawn)
            free(q->over);
        else
            s->quantity[kept++] = *q;
    }
    s->quantities = kept;
    if (kept == 0)
        return fault_set(f, STATUS_REFUSED,
                         "no quantity can be drawn as a curve; add a quantity of a transient "
                         "analysis, of a load path with stations or of a harmonic analysis, or "
                         "choose another case, such as lee_frame");
    for (int i = 0; i < kept; i++)
        TRY(add_phase(s, i, f));
    for (int i = 0; i < s->analyses; i++)
        TRY(read_densely(s, i, f));
    return STATUS_OK;
}

static status solve_one(const plot_request *r, const case_type *type, int index, sweep *s,
                        solution_choice *why, FILE *to, fault *f)
{
    char note[DEFAULTS_NOTE];
    truths none = {0};
    chosen_formulations chosen = {.formulations = r->chosen.formulations > 0};
    mesh_list meshes = r->meshes;
    const truths_options usual = {.packed = NULL};
    if (chosen.formulations > 0)
        chosen.formulation[0] = r->chosen.formulation[index];
    const defaults missing = {.wanted = {.type = type,
                                         .parameter = r->of.parameter,
                                         .select = r->select,
                                         .keep_all = r->solver.keep_all,
                                         .steps = r->steps,
                                         .threads = r->solver.threads},
                              .chosen = &chosen,
                              .meshes = &meshes,
                              .truths = &usual};
    TRY(defaults_fill(&missing, note, why, f));
    solution_choice_free(why);
    const solution_request what = defaults_request(&missing);
    TRY(solution_plan(&what, s, f));
    TRY(make_curves(&s->point[0].scene, f));
    fputs(note, stderr);
    formulation_start_guard(&what.formulation, r->chosen.time_limit);
    const status solved = solution_run(&what, why, s, f);
    const cell_result *cell = &s->series[0].cell[0];
    if (solved == STATUS_FAULT || cell_values(cell) == 0)
        return solved != STATUS_OK ? solved
                                   : fault_set(f, STATUS_REFUSED,
                                               "no quantity has a value, so no figure was drawn; "
                                               "'beamwork solve' prints the reasons");
    if (solved != STATUS_OK)
        message_fail(solved, f->text);
    fputs(ftell(to) > 0 ? "," : "[", to);
    return json_write_solution(to, s, &none, f);
}

static status solve_all(const plot_request *r, const case_type *type, FILE *to, fault *f)
{
    status outcome = STATUS_OK;
    for (int i = 0; i == 0 || i < r->chosen.formulations; i++) {
        sweep s = {0};
        solution_choice why = {.formulation = ""};
        outcome = solve_one(r, type, i, &s, &why, to, f);
        sweep_free(&s);
        solution_choice_free(&why);
        if (outcome != STATUS_OK && r->chosen.formulations > 1)
            fprintf(stderr, "beamwork: %s: %s\n", r->chosen.formulation[i].key, f->text);
        if (outcome == STATUS_FAULT)
            return outcome;
    }
    if (ftell(to) <= 0)
        return outcome;
    fputc(']', to);
    return fflush(to) == 0 && fseek(to, 0, SEEK_SET) == 0
               ? STATUS_OK
               : fault_set(f, STATUS_FAULT,
                           "a temporary file cannot be written in /tmp; make /tmp writable, and "
                           "free space there");
}

static void become(int from, int to, const char *folder, const char *form)
{
    if (dup2(from, STDIN_FILENO) >= 0 && dup2(to, STDOUT_FILENO) >= 0)
        execl(python, python, "-I", "-B", "-c", begin_program, folder, form, (char *)NULL);
    _exit(127);
}

static status draw(FILE *solutions, const char *folder, const char *form, FILE *picture, fault *f)
{
    int how = -1;
    const pid_t child = fork();
    if (child == 0)
        become(fileno(solutions), fileno(picture), folder, form);
    if (child > 0 && waitpid(child, &how, 0) == child && how == 0)
        return STATUS_OK;
    if (child > 0 && WIFEXITED(how) && WEXITSTATUS(how) == COULD_NOT)
        return fault_set(f, STATUS_FAULT, "no figure was drawn; the reason is above");
    return fault_set(f, STATUS_FAULT,
                     "the plotting program cannot be run; install %s and matplotlib, on Debian and "
                     "Ubuntu with 'sudo apt-get install python3-matplotlib'",
                     python);
}

static const char *form_of(const char *path, fault *f)
{
    static const char *const forms[] = {"png", "svg", "pdf", "csv"};
    const char *dot = strrchr(place_leaf(path), '.');
    for (size_t i = 0; dot != NULL && i < sizeof forms / sizeof forms[0]; i++)
        if (strcasecmp(dot + 1, forms[i]) == 0)
            return forms[i];
    fault_set(f, STATUS_REFUSED,
              "-o %.200s: plot writes figures (.png, .svg, .pdf) and tables (.csv); give a name "
              "with one of these endings, such as figure.png",
              path);
    return NULL;
}

static status find_reports(char folder[PATH_MAX], fault *f)
{
    char script[PATH_MAX];
    TRY(derive_script("../../reports/graph.py", script, f)); /* from reference/derive */
    if (access(script, R_OK) != 0 || realpath(script, folder) == NULL)
        return fault_set(f, STATUS_FAULT,
                         "%.200s: the plotting program was not found; run beamwork from a clone or "
                         "an installed copy, or set the environment variable BEAMWORK_REFERENCE to "
                         "the folder 'reference' of a clone",
                         script);
    for (int i = 0; i < 2; i++)
        *strrchr(folder, '/') = '\0';
    return STATUS_OK;
}

static status draw_from(const plot_request *r, const case_type *type, FILE *solutions,
                        const char *path, fault *f)
{
    char folder[PATH_MAX];
    output picture;
    const char *form = form_of(path, f);
    if (form == NULL)
        return STATUS_REFUSED;
    TRY(files_check(r->of.line, 0, NULL, f));
    TRY(find_reports(folder, f));
    TRY(solve_all(r, type, solutions, f));
    TRY(output_open(path, &picture, f));
    TRY(output_finish(&picture, draw(solutions, folder, form, picture.stream, f), f));
    printf("%s\n", path);
    return STATUS_OK;
}

static int answer(const command_line *l, void *request)
{
    plot_request *r = request;
    (void)l;
    char path[PATH_MAX];
    fault f = {""};
    const case_type *type = case_input_find(&r->of);
    if (type == NULL)
        return r->of.refusal;
    if (r->meshes.count > 1)
        return message_fail(STATUS_REFUSED, "plot accepts one number of elements and any number of "
                                            "formulations; give a single number, such as -n 4");
    snprintf(path, sizeof path, "%s%s", r->output != NULL ? r->output : type->name,
             r->output != NULL ? "" : ".png");
    FILE *solutions = tmpfile();
    const status outcome = solutions != NULL
                               ? draw_from(r, type, solutions, path, &f)
                               : fault_set(&f, STATUS_FAULT,
                                           "a temporary file cannot be written in /tmp; make /tmp "
                                           "writable, and free space there");
    if (solutions != NULL)
        fclose(solutions);
    return message_exit(outcome, &f);
}

#define IN(at) .member = offsetof(plot_request, at)
static const verb_option own[] = {
    {"output", 'o', "FILE",
     "figure (.png, .svg, .pdf), or table with a column for each quantity (.csv); default: "
     "NAME.png in the current folder",
     IN(output), .traits = OPTION_OUTPUT},
    {"steps", 0, "N",
     "initial number of load steps between two stations of a path; the step size adapts", IN(steps),
     .least = 1, .most = 1000000},
    {0}};
static const verb_group shared[] = {SHARED(case, of),
                                    SHARED(formulations, chosen),
                                    SHARED(meshes, meshes),
                                    SHARED(select, select),
                                    SHARED(time_limit, chosen),
                                    SHARED(solver, solver),
                                    {NULL, 0}};
const verb verb_plot = {
    "plot",
    "CASE",
    "draws curves of quantities: histories, paths, responses",
    "Solves one case, or your own scene (CASE is then the path of the file), and draws its "
    "quantities as curves: over time, over a path, over frequency (Bode diagrams: amplitudes on a "
    "logarithmic scale, and phases), or over the quantity that the key 'x' names. A quantity that "
    "is a single value of a motion, a path or a harmonic analysis is also drawn as a curve (except "
    "times and periods). Motions without spectra are sampled at 300 times, static paths with one "
    "station at 20 states. Each -f adds a line; -k selects quantities. Figures require "
    "python3-matplotlib.",
    "beamwork plot lee_frame -f collocation -n 4 -o frame.png\n"
    "beamwork plot elastica -k theta -f beamw -f collocation -n 4 -o angle.pdf",
    shared,
    own,
    sizeof(plot_request),
    .place = VERB_COMPUTE + 15,
    .answer = answer};
