#include "harness/study/study.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void passed(const verdict *v, char *text, size_t size)
{
    const char *digits =
        v->below_digits ? "; the difference is below the last digit of the reference value" : "";
    if (v->fit.kind == LIMIT_NOISE_DOMINATED)
        snprintf(text, size,
                 "has converged to the reference value: the values on the last meshes differ only "
                 "by rounding%s",
                 digits);
    else if (isfinite(v->fit.order))
        snprintf(text, size, "converges to the reference value, order %.2g%s", v->fit.order,
                 digits);
    else
        snprintf(text, size,
                 "agrees with the reference value within the tolerance; the order is not known%s",
                 digits);
}

/* Writes the uncertainty of a limit in percent of the reference value. If the reference value is
 * zero or very small, errors are relative to near_zero, and the uncertainty has the unit of the
 * quantity. */
static void uncertainty_of(const verdict *v, char text[2 * ROUNDING_TEXT])
{
    const double size = fabs(v->truth->value), apart = fabs(v->fit.limit - v->truth->value);
    const int by_truth = size > 0 && fabs(v->error) * size >= apart * (1 - 1e-9);
    char digits[ROUNDING_TEXT];
    rounding_digits(v->fit.limit_uncertainty * (by_truth ? 100 / size : 1), 2, digits);
    snprintf(text, 2 * ROUNDING_TEXT, "%s%s", digits,
             by_truth ? " %" : " in the unit of the quantity");
}

static const char *remedy(const mesh_limit *fit)
{
    if (fit->kind == LIMIT_NOISE_DOMINATED)
        return "";
    return fit->meshes < 4 ? "; use at least four meshes" : "; use finer meshes";
}

static void undecided(const verdict *v, char *text, size_t size)
{
    char uncertainty[2 * ROUNDING_TEXT];
    if (!isfinite(v->fit.limit_uncertainty)) {
        snprintf(text, size,
                 "undecided: one mesh does not determine a limit; use at least four meshes");
        return;
    }
    uncertainty_of(v, uncertainty);
    snprintf(text, size,
             "undecided: error of the limit %+.3g %%, uncertainty %s (%s%s, %d meshes)%s",
             100 * v->error, uncertainty, limit_kind_name(v->fit.kind),
             v->fit.kind == LIMIT_NOT_YET ? " asymptotic" : "", v->fit.meshes, remedy(&v->fit));
}

/* Describes a biased limit. If it is neither the reference value nor the limit derived for the
 * formulation, it is probably not the true limit. Values seem to converge while elements are longer
 * than the thickness of a boundary layer. */
static void biased(const verdict *v, char *text, size_t size)
{
    char uncertainty[2 * ROUNDING_TEXT];
    if (v->predicted == NULL) {
        snprintf(text, size, "has a different limit within the tolerance: %+.3g %%",
                 100 * v->error);
        return;
    }
    uncertainty_of(v, uncertainty);
    snprintf(text, size,
             "seems to have a different limit within the tolerance (error %+.3g %%, uncertainty "
             "%s), which also differs from the derived limit %.10g; use finer meshes",
             100 * v->error, uncertainty, v->predicted->value);
}

static void not_evaluated(const verdict *v, char *text, size_t size)
{
    if (v->theory_truth != NULL && v->theory_truth->theory[0] != '\0')
        snprintf(text, size,
                 "no reference value for its shear theory; its limit is %+.3g %% from the "
                 "reference value for %s",
                 100 * (v->fit.limit / v->theory_truth->value - 1), v->theory_truth->theory);
    else if (v->model_truth != NULL && strcmp(v->model_truth->kind, "agreement") == 0)
        snprintf(text, size,
                 "no reference value to compare with; its limit is %+.2g %% from that on which %s",
                 100 * v->model_error, v->model_truth->source);
    else
        snprintf(text, size, "no reference value to compare with");
}

static void other_model(const verdict *v, char *text, size_t size)
{
    const int agreed = v->model_truth != NULL && strcmp(v->model_truth->kind, "agreement") == 0;
    if (v->model_truth != NULL && isfinite(v->model_error))
        snprintf(text, size, "%s; its limit is %+.3g %% from %s%s%s", v->reason,
                 100 * v->model_error, agreed ? "that on which " : "the reference value (",
                 agreed ? v->model_truth->source : v->model_truth->kind, agreed ? "" : ")");
    else
        snprintf(text, size, "%s", v->reason);
}

void sentence_of_verdict(const verdict *v, double least_order, char *text, size_t size)
{
    switch (v->kind) {
    case VERDICT_PASS:
        passed(v, text, size);
        return;
    case VERDICT_BIASED:
        biased(v, text, size);
        return;
    case VERDICT_WRONG_LIMIT:
        snprintf(text, size,
                 3 * v->fit.limit_uncertainty > fabs(v->fit.limit - v->truth->value)
                     ? "does not converge on these meshes and has a wrong value: %+.3g %%"
                     : "converges to a wrong limit: %+.3g %%",
                 100 * v->error);
        return;
    case VERDICT_BIASED_AS_PREDICTED:
    case VERDICT_WRONG_AS_PREDICTED:
        snprintf(text, size,
                 "converges to its derived limit %.10g: %+.3g %% from the reference value",
                 v->predicted->value, 100 * v->error);
        return;
    case VERDICT_LOW_ORDER:
        snprintf(text, size,
                 "converges to the reference value, but with order %.2g instead of %.2g",
                 v->fit.order, least_order);
        return;
    case VERDICT_UNDECIDED:
        undecided(v, text, size);
        return;
    case VERDICT_DIVERGED:
        snprintf(text, size, "has no value on the finest mesh: %s", v->reason);
        return;
    case VERDICT_REFUSED:
        snprintf(text, size, "refused: %s", v->reason);
        return;
    case VERDICT_SKIP:
        snprintf(text, size, "skipped: %s", v->reason);
        return;
    case VERDICT_OTHER_MODEL:
        other_model(v, text, size);
        return;
    case VERDICT_NO_TRUTH:
    case VERDICT_KINDS:
        break;
    }
    not_evaluated(v, text, size);
}

static void add_part(char *text, size_t size, int *parts, const char *joint, const char *part)
{
    const size_t used = strlen(text);
    snprintf(text + used, size - used, "%s%s", (*parts)++ > 0 ? joint : "", part);
}

static void count_part(char *text, size_t size, int *parts, int count, const char *one,
                       const char *many)
{
    char part[160];
    if (count == 0)
        return;
    snprintf(part, sizeof part, "%d %s", count, count == 1 ? one : many);
    add_part(text, size, parts, ", ", part);
}

static int count_undecided(const evaluation *j)
{
    int count = 0;
    for (int i = 0; i < j->verdicts; i++)
        count += !j->verdict[i].matches && j->verdict[i].kind == VERDICT_UNDECIDED;
    return count;
}

static void failures(const evaluation *j, char *text, size_t size)
{
    int parts = 0;
    count_part(text, size, &parts, j->breaches, "formulation violates the interface requirements",
               "formulations violate the interface requirements");
    count_part(text, size, &parts, j->unexpected, "verdict differs from the expected one",
               "verdicts differ from the expected ones");
    const int undecided_ones = count_undecided(j);
    if (undecided_ones > 0 && j->unexpected == 1)
        snprintf(text + strlen(text), size - strlen(text), " (undecided)");
    else if (undecided_ones > 0)
        snprintf(text + strlen(text), size - strlen(text), " (%d of them undecided)",
                 undecided_ones);
    count_part(text, size, &parts, j->regressions, "result is worse than in the previous run",
               "results are worse than in the previous run");
    count_part(text, size, &parts, j->disagreements, "value differs from its stored value",
               "values differ from their stored values");
    count_part(text, size, &parts, j->flaws, "inconsistent run record", "inconsistent run records");
    count_part(text, size, &parts, j->unobserved, "known deviation was not observed",
               "known deviations were not observed");
    count_part(text, size, &parts, j->unmet, "reference value refers to an unknown name",
               "reference values refer to unknown names");
}

typedef struct known_value {
    int derived[2];
    int by_rule;
} known_value;

static known_value count_known(const evaluation *j)
{
    known_value out = {{0}, 0};
    for (int i = 0; i < j->verdicts; i++) {
        const verdict *v = &j->verdict[i];
        if (v->rule == NULL || !v->matches)
            continue;
        out.derived[0] += v->kind == VERDICT_BIASED_AS_PREDICTED;
        out.derived[1] += v->kind == VERDICT_WRONG_AS_PREDICTED;
        out.by_rule +=
            v->kind != VERDICT_BIASED_AS_PREDICTED && v->kind != VERDICT_WRONG_AS_PREDICTED;
    }
    return out;
}

/* Describes the verdicts on formulations that do not affect the exit status, with the number of
 * verdicts that would need a known deviation. */
static void new_ones(const evaluation *j, char *text, size_t size)
{
    if (j->proposed == 0)
        snprintf(text, size, "%d %s; none requires a known deviation", j->is_new,
                 j->is_new == 1 ? "belongs to a new formulation and does not affect the exit status"
                                : "belong to new formulations and do not affect the exit status");
    else
        snprintf(text, size,
                 "without effect on the exit status: %d of %d %s %s not a pass and would need a "
                 "known deviation (--propose-deviations FILE lists %s)",
                 j->proposed, j->is_new,
                 j->is_new == 1 ? "verdict of a new formulation" : "verdicts of new formulations",
                 j->proposed == 1 ? "is" : "are", j->proposed == 1 ? "it" : "them");
}

/* Describes the verdicts on imported values that do not affect the exit status. */
static void imported_ones(const evaluation *j, char *text, size_t size)
{
    if (j->imported_failed == 0)
        snprintf(text, size,
                 "%d %s on imported values %s not affect the exit status (--imported-must-pass)",
                 j->imported, j->imported == 1 ? "verdict" : "verdicts",
                 j->imported == 1 ? "does" : "do");
    else
        snprintf(text, size,
                 "without effect on the exit status: %d of %d %s on imported values %s not as "
                 "expected (--imported-must-pass lets %s fail the run)",
                 j->imported_failed, j->imported, j->imported == 1 ? "verdict" : "verdicts",
                 j->imported_failed == 1 ? "is" : "are", j->imported_failed == 1 ? "it" : "them");
}

static void expected_deviations(const evaluation *j, char *text, size_t size)
{
    const known_value k = count_known(j);
    const int derived = k.derived[0] + k.derived[1];
    char part[400];
    int parts = 0;
    if (derived > 0) {
        snprintf(
            part, sizeof part,
            "%d of them %s from the reference value (%d within the tolerance, %d outside it), as "
            "derived for %s (beamwork explain \"wrong limit, as predicted\")",
            derived, derived == 1 ? "concerns a limit that differs" : "concern limits that differ",
            k.derived[0], k.derived[1], derived == 1 ? "its formulation" : "these formulations");
        add_part(text, size, &parts, ", ", part);
    }
    if (k.by_rule > 0) {
        snprintf(part, sizeof part, "%d %s%s explained by a known deviation", k.by_rule,
                 derived > 0 ? "more " : "of them ", k.by_rule == 1 ? "is" : "are");
        add_part(text, size, &parts, ", ", part);
    }
    if (j->tolerated > 0) {
        snprintf(part, sizeof part,
                 "%d of them %s no pass, but within the tolerance given by --tolerance",
                 j->tolerated, j->tolerated == 1 ? "is" : "are");
        add_part(text, size, &parts, ", ", part);
    }
    if (j->is_new > 0) {
        new_ones(j, part, sizeof part);
        add_part(text, size, &parts, "; ", part);
    }
    if (j->imported > 0) {
        imported_ones(j, part, sizeof part);
        add_part(text, size, &parts, "; ", part);
    }
}

void sentence_of_run(const sweep *s, const evaluation *j, char *text, size_t size)
{
    const int bad = evaluation_exit(j) == 1, checked = bad || j->evaluated + j->agreements > 0;
    char more[FAULT_TEXT * 4] = "";
    text[0] = '\0';
    if (!checked)
        return;
    if (bad)
        failures(j, more, sizeof more);
    else
        expected_deviations(j, more, sizeof more);
    const char *word = bad ? "FAIL" : "PASS", *of = "";
    if (s->unfinished > 0) {
        word = s->partial ? "INCOMPLETE" : "INTERRUPTED";
        of = s->partial ? "for the existing part " : "until then ";
    }
    if (bad)
        snprintf(text, size, "%s: %s.", word, more);
    else
        snprintf(text, size, "%s: %s%s%s%s.", word, of,
                 j->proposed + j->imported_failed > 0
                     ? "everything that affects the exit status is as expected"
                     : "every verdict is as expected",
                 more[0] != '\0' ? "; " : "", more);
}

/* Returns the decimal exponent of the value after rounding to the given number of digits. */
static int exponent_of(double value, int digits)
{
    char text[ROUNDING_TEXT];
    snprintf(text, sizeof text, "%.*e", digits - 1, value);
    return atoi(strchr(text, 'e') + 1);
}

static void with_exponent(double value, int digits, int sign, char text[ROUNDING_TEXT])
{
    char padded[ROUNDING_TEXT];
    snprintf(padded, sizeof padded, "%+.*e", digits - 1, value);
    char *exponent = strchr(padded, 'e');
    const int power = atoi(exponent + 1), first = padded[0] == '+' && !sign;
    *exponent = '\0';
    snprintf(text, ROUNDING_TEXT, "%.20se%d", padded + first, power);
}

void rounding_digits(double value, int digits, char text[ROUNDING_TEXT])
{
    if (!isfinite(value)) {
        snprintf(text, ROUNDING_TEXT, "-");
        return;
    }
    if (value == 0) {
        snprintf(text, ROUNDING_TEXT, "0");
        return;
    }
    const int exponent = exponent_of(value, digits), behind = digits - 1 - exponent;
    const int widest = digits > 9 ? digits : 9;
    if (exponent < -3 || exponent >= widest)
        with_exponent(value, digits, 0, text);
    else if (behind >= 0)
        snprintf(text, ROUNDING_TEXT, "%.*f", behind, value);
    else
        snprintf(text, ROUNDING_TEXT, "%.0f", round(value / pow(10, -behind)) * pow(10, -behind));
}

void rounding_known(double value, double uncertainty, char text[ROUNDING_TEXT])
{
    const int unknown = 7;
    int digits = unknown;
    if (uncertainty == 0) {
        snprintf(text, ROUNDING_TEXT, "%.*g", ROUNDING_MOST, value);
        return;
    }
    if (isfinite(value) && value != 0 && isfinite(uncertainty))
        digits = exponent_of(value, ROUNDING_MOST) - exponent_of(uncertainty, 2) + 2;
    if (digits > ROUNDING_MOST)
        digits = ROUNDING_MOST;
    rounding_digits(value, digits > 1 ? digits : 1, text);
}

void rounding_percent(double error, char text[ROUNDING_TEXT])
{
    const double least = 0.01, some = 1000, many = 1e6; /* [%] */
    const double percent = 100 * error, size = fabs(percent);
    if (!isfinite(error)) {
        snprintf(text, ROUNDING_TEXT, "-");
        return;
    }
    if (size == 0)
        snprintf(text, ROUNDING_TEXT, "0");
    else if (size < least || size >= many)
        with_exponent(percent, 2, 1, text);
    else
        snprintf(text, ROUNDING_TEXT, "%+.*f", size < some ? 4 : 1, percent);
    const size_t used = strlen(text);
    snprintf(text + used, ROUNDING_TEXT - used, " %%");
}

double rounds_least(const rounds_reading *c)
{
    double least = INFINITY;
    for (int i = 0; i < c->rounds; i++)
        least = fmin(least, c->round[i]);
    return least;
}

double rounds_most(const rounds_reading *c)
{
    double most = 0;
    for (int i = 0; i < c->rounds; i++)
        most = fmax(most, c->round[i]);
    return c->rounds > 0 ? most : INFINITY;
}

int rounds_compare(const rounds_reading *a, const rounds_reading *b)
{
    return (rounds_most(b) < rounds_least(a)) - (rounds_most(a) < rounds_least(b));
}

double dense_reference_seconds(const dense_reference *b, long iterations)
{
    if (b->whole.rounds > 0)
        return rounds_least(&b->whole);
    return b->unknowns > 0 ? b->iteration * (double)iterations : INFINITY;
}
