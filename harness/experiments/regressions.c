#include "harness/experiments/experiments_impl.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Allowed relative increase of an error. LAPACK kernels for different processors change small
 * errors of some series by up to 1.2 %. */
static const double LARGER = 0.02;

/* Allowed relative change of a limit, unless an exact reference value checks the limit as
 * closely. */
static const double MOVED = 1e-5;

static status read_back(const sweep *s, const evaluation *j, stored_results *out, fault *f)
{
    const char *folder = getenv("TMPDIR");
    char path[PATH_MAX];
    const environment e = environment_now(1);
    if (snprintf(path, sizeof path, "%s/beamwork-XXXXXX", folder != NULL ? folder : "/tmp") >=
        (int)sizeof path)
        return fault_set(f, STATUS_FAULT,
                         "the folder in the environment variable TMPDIR has too long a name; set a "
                         "shorter one, such as TMPDIR=/var/tmp");
    const int file = mkstemp(path);
    if (file < 0)
        return fault_set(f, STATUS_FAULT,
                         "%.200s: a temporary file cannot be created; set the environment variable "
                         "TMPDIR to a writable folder, such as /var/tmp",
                         path);
    close(file);
    status outcome = store_write(path, NULL, s, j, &e, f);
    if (outcome == STATUS_OK)
        outcome = results_read(path, out, f);
    unlink(path);
    return outcome;
}

static status add_line(const char *line, evaluation *j, fault *f)
{
    static const comparison_kind counted[] = {CHANGE_WORSE, CHANGE_MISSING};
    for (size_t i = 0; i < sizeof counted / sizeof counted[0]; i++) {
        const char *kind = comparison_kind_names[counted[i]];
        const size_t length = strlen(kind);
        if (strncmp(line, kind, length) != 0 || line[length] != ' ')
            continue;
        const char *name = line + length + strspn(line + length, " "), *why = strstr(name, ": ");
        regression one;
        snprintf(one.of, sizeof one.of, "%.*s", why != NULL ? (int)(why - name) : (int)strlen(name),
                 name);
        snprintf(one.why, sizeof one.why, "%s%s", counted[i] == CHANGE_MISSING ? "gone" : "",
                 why != NULL ? why + (counted[i] == CHANGE_MISSING ? 0 : 2) : "");
        return memory_append(&j->regression, &j->regressions, &one, sizeof one, "regressions", f);
    }
    return STATUS_OK;
}

static status add_lines(char *text, evaluation *j, fault *f)
{
    char *rest = NULL;
    for (char *line = strtok_r(text, "\n", &rest); line != NULL; line = strtok_r(NULL, "\n", &rest))
        TRY(add_line(line, j, f));
    return STATUS_OK;
}

static status compare(const stored_results *former, const char *name, const stored_results *now,
                      evaluation *j, fault *f)
{
    const comparison_limits limits = {LARGER, RESULTS_FLOOR, DBL_MAX};
    char *text = NULL;
    size_t size = 0;
    comparison c;
    FILE *to = open_memstream(&text, &size);
    if (to == NULL)
        return fault_memory(f, "a comparison");
    comparison_run(to, former, now, &limits, NULL, &c);
    status outcome = fclose(to) == 0 ? STATUS_OK : fault_memory(f, "a comparison");
    if (outcome == STATUS_OK && c.pairs == 0)
        outcome =
            fault_set(f, STATUS_REFUSED,
                      "--not-worse-than %.120s: the file contains no results of this run; give the "
                      "results of a run with the same cases (-k) and formulations (-f)",
                      name);
    if (outcome == STATUS_OK)
        outcome = add_lines(text, j, f);
    free(text);
    return outcome;
}

/* Returns the limit that the previous run has stored for the quantity and formulation of the
 * verdict at the default point; NULL: none. */
static const result_limit *limit_of_former(const stored_results *former, const sweep *s,
                                           const verdict *v)
{
    const series *one = &s->series[v->series];
    const sweep_point *p = &s->point[one->point];
    char name[FAULT_TEXT];
    snprintf(name, sizeof name, "%s/default/%s", p->type->name, one->formulation.key);
    for (int i = 0; p->text[0] == '\0' && i < former->seriess; i++)
        for (int k = 0; strcmp(former->series[i].name, name) == 0 && k < former->series[i].limits;
             k++)
            if (strcmp(former->series[i].limit[k].quantity, p->scene.quantity[v->quantity].name) ==
                0)
                return &former->series[i].limit[k];
    return NULL;
}

/* Returns 1 if an exact reference value checks the limit to within `slack`, uncertainties
 * included. */
static int is_evaluated_closely(const verdict *v, double slack)
{
    return (v->kind == VERDICT_PASS || v->kind == VERDICT_BIASED_AS_PREDICTED ||
            v->kind == VERDICT_WRONG_AS_PREDICTED) &&
           strcmp(v->truth->kind, "exact") == 0 &&
           3 * v->fit.limit_uncertainty + v->truth->uncertainty <= slack;
}

static status find_moved(const stored_results *former, const sweep *s, evaluation *j, fault *f)
{
    for (int i = 0; i < j->verdicts; i++) {
        const verdict *v = &j->verdict[i];
        const series *one = &s->series[v->series];
        const scene_quantity *q = &s->point[one->point].scene.quantity[v->quantity];
        const result_limit *old = isfinite(v->fit.limit) && v->kind != VERDICT_OTHER_MODEL
                                      ? limit_of_former(former, s, v)
                                      : NULL;
        if (old == NULL || one->imported != NULL)
            continue;
        const double slack = MOVED * fmax(fabs(old->value), q->near_zero);
        if (fabs(v->fit.limit - old->value) <= slack || is_evaluated_closely(v, slack))
            continue;
        regression new;
        snprintf(new.of, sizeof new.of, "%s/default/%s", s->point[one->point].type->name,
                 one->formulation.key);
        snprintf(new.why, sizeof new.why,
                 "limit of %s changed from %.10g to %.10g %s; no reference value is accurate "
                 "enough to check this change",
                 q->name, old->value, v->fit.limit, q->unit);
        TRY(memory_append(&j->regression, &j->regressions, &new, sizeof new, "regressions", f));
    }
    return STATUS_OK;
}

status regressions_find(const stored_results *former, const char *name, const sweep *s,
                        evaluation *j, fault *f)
{
    stored_results now = {.cells = 0};
    status outcome = read_back(s, j, &now, f);
    if (outcome == STATUS_OK)
        outcome = compare(former, name, &now, j, f);
    if (outcome == STATUS_OK)
        outcome = find_moved(former, s, j, f);
    results_free(&now);
    return outcome;
}
