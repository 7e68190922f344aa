#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/catalogue/parameters.h"
#include "harness/cli/cli.h"
#include "harness/record/csv.h"
#include "harness/record/follow_record.h"
#include "harness/record/json.h"
#include "harness/record/output.h"
#include "harness/record/store.h"
#include "harness/record/system_folder.h"
#include "harness/study/plan.h"
#include "harness/tables/table_follow.h"
#include "harness/tables/table_solution.h"

static status write_to(FILE *to, const command_request *r, const sweep *s, const truths *t,
                       fault *f)
{
    if (strcmp(r->format, "json") == 0)
        return json_write_solution(to, s, t, f);
    if (strcmp(r->format, "csv") == 0)
        csv_solution(to, s);
    else
        table_solution(to, s, t);
    return STATUS_OK;
}

static status write_out(const command_request *r, const sweep *s, const truths *t, fault *f)
{
    output file;
    if (r->shapes > 0) {
        const environment e = environment_now(1);
        table_solution(stdout, s, t);
        TRY(output_flush(f));
        return store_write_solution(r->output, s, &e, f);
    }
    TRY(output_open(r->output, &file, f));
    return output_finish(&file, write_to(file.stream, r, s, t, f), f);
}

/* The matrices of all states that were reached, where they are wanted. */
static status write_matrices(const command_request *r, const sweep *s, fault *f)
{
    const cell_result *cell = &s->series[0].cell[0];
    char title[200];
    if (r->matrices == NULL)
        return STATUS_OK;
    snprintf(title, sizeof title, "%s, %s, %d elements per member", s->point[0].scene.name,
             r->formulation[0].key, r->mesh[0]);
    return system_folder_write(r->matrices, title, &s->point[0].scene, &cell->solve.systems, f);
}

/* The one cell, solved in this process so that its options reach it. */
static status solve_cell(const command_request *r, sweep *s, fault *f)
{
    point *p = &s->point[0];
    if (r->matrices != NULL)
        scene_need(&p->scene, FEATURE_MASS);
    cell_request request = {.scene = &p->scene, .elements = r->mesh[0], .keep_all = r->keep_all};
    cell_formulation(&request, &r->formulation[0]);
    request.solve.steps_between = r->steps;
    request.solve.shapes = r->shapes;
    request.solve.systems = r->matrices != NULL;
    request.threads = r->threads;
    return cell_run(&request, &s->series[0].cell[0], f);
}

/* Which analysis was made up where the scene states none. */
static void tell_analysis(const command_request *r, const scene *s)
{
    if (r->scene == NULL || scene_file_states(r->scene, "analyses"))
        return;
    const scene_analysis *a = &s->analysis[0];
    if (a->kind == SCENE_LINEAR) {
        fprintf(stderr, "beamwork: the scene states no analysis; this is a linear one, as "
                        "analyses: {run: {linear: {}}}\n");
        return;
    }
    const scene_path *path = scene_path_of(a);
    fprintf(stderr,
            "beamwork: the scene states no analysis; its motions are followed to their end, as "
            "analyses: {run: {static: {stations: [%g]}}}\n",
            path->value[path->stations - 1]);
}

/* NAME=A..B/N: both ends within the limits of the parameter. */
static status range_of(const command_request *r, const case_type *type, follow_request *out,
                       fault *f)
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
                         "--follow '%.60s': give NAME=A..B/N with N from 1 to 100000, such as "
                         "width=0.01..0.03/20",
                         r->follow);
    memcpy(value, r->parameter, sizeof value);
    snprintf(text, sizeof text, "%.*s", (int)(dots - r->follow), r->follow);
    TRY(assignment_set(&list, text, value, NULL, &out->parameter, f));
    out->from = value[out->parameter];
    snprintf(text, sizeof text, "%.*s%.*s", (int)(ends + 1 - r->follow), r->follow,
             (int)(slash - dots - 2), dots + 2);
    TRY(assignment_set(&list, text, value, NULL, &out->parameter, f));
    out->to = value[out->parameter];
    return fabs(out->to - out->from) > 0
               ? STATUS_OK
               : fault_set(f, STATUS_REFUSED, "--follow '%.60s': both ends are the same; give two",
                           r->follow);
}

static status write_curves(const command_request *r, const char *name, const follow_curves *c,
                           fault *f)
{
    output file;
    status written = STATUS_OK;
    TRY(output_open(r->output, &file, f));
    if (strcmp(r->format, "json") == 0)
        written = follow_record_json(file.stream, name, c, f);
    else if (strcmp(r->format, "csv") == 0)
        follow_record_csv(file.stream, name, c);
    else
        table_follow(file.stream, name, c);
    return output_finish(&file, written, f);
}

/* --follow: modes over a parameter instead of one solution. */
static status follow_modes(const command_request *r, const case_type *type, fault *f)
{
    char name[SCENE_NAME];
    follow_curves curves;
    follow_request what = {
        .cell = {
            .type = type, .elements = r->mesh[0], .keep_all = r->keep_all, .threads = r->threads}};
    if (r->shapes > 0 || r->matrices != NULL)
        return fault_set(f, STATUS_REFUSED,
                         "--follow gives curves of modes: leave --shapes and --matrices");
    TRY(range_of(r, type, &what, f));
    snprintf(name, sizeof name, "%.*s", (int)strcspn(r->follow, "="), r->follow);
    TRY(files_check(r, 0, case_input_truths_path(r), f));
    cell_formulation(&what.cell, &r->formulation[0]);
    what.cell.solve.steps_between = r->steps;
    memcpy(what.cell.parameter, r->parameter, sizeof what.cell.parameter);
    TRY(follow_run(&what, &curves, f));
    const status written = write_curves(r, name, &curves, f);
    follow_free(&curves);
    return written;
}

static int solve_request(command_request *r)
{
    sweep s;
    fault f = {""};
    truths t = {0};
    const case_type *type = case_input_find(r);
    if (type == NULL)
        return r->refusal;
    if (r->formulations != 1)
        return message_fail(
            STATUS_REFUSED,
            "which formulation? Give one -f; 'beamwork list formulations' shows them");
    if (r->meshes != 1)
        return message_fail(STATUS_REFUSED, "how many elements per member? Give one -n");
    if (r->follow != NULL)
        return message_exit(follow_modes(r, type, &f), &f);
    if (r->shapes > 0 && r->output == NULL)
        return message_fail(STATUS_REFUSED, "--shapes: into which file? Give -o FILE");
    status outcome = files_check(r, r->shapes > 0, case_input_truths_path(r), &f);
    if (outcome != STATUS_OK)
        return message_fail(outcome, f.text);
    outcome = case_input_truths(r, &t, &f);
    if (outcome != STATUS_OK && r->truths == NULL &&
        r->scene == NULL) /* a solution needs none: say so and go on */
        fprintf(stderr, "beamwork: without truths: %s\n", f.text);
    else if (outcome != STATUS_OK)
        return message_fail(outcome, f.text);
    outcome = plan_one(type, r->parameter, r->formulation, 1, r->mesh, 1, &s, &f);
    if (outcome != STATUS_OK) {
        truths_free(&t);
        return message_fail(outcome, f.text);
    }
    tell_analysis(r, &s.point[0].scene);
    const status solved = solve_cell(r, &s, &f);
    fault unwritten = {""};
    int code = EXIT_AS_EXPECTED;
    if (solved == STATUS_REFUSED || solved == STATUS_FAULT) {
        code = message_fail(solved, f.text);
    } else {
        outcome = write_out(r, &s, &t, &unwritten);
        if (outcome == STATUS_OK)
            outcome = write_matrices(r, &s, &unwritten);
        code = EXIT_AS_EXPECTED;
        if (outcome != STATUS_OK)
            code = message_fail(outcome, unwritten.text);
        else if (solved != STATUS_OK)
            code = message_fail(solved, f.text);
    }
    sweep_free(&s);
    truths_free(&t);
    return code;
}

int cli_solve(int count, char **arguments)
{
    return command_run(
        "solve", "CASE",
        "Solves one case with one formulation and one mesh and shows every quantity with its "
        "error."
        "\vbeamwork solve c_column -f beamw -n 8 --set section_data=printed",
        "fnsFoKSPRVtTY", count, arguments, solve_request);
}
