#include "harness/records/records.h"

#include <math.h>
#include <string.h>

#include "cases/scene/scene.h"
#include "harness/model/model.h"

static void escaped(FILE *to, const char *text)
{
    for (; *text != '\0'; text++)
        switch (*text) {
        case '<':
            fputs("&lt;", to);
            break;
        case '>':
            fputs("&gt;", to);
            break;
        case '&':
            fputs("&amp;", to);
            break;
        case '"':
            fputs("&quot;", to);
            break;
        default:
            fputc(*text, to);
        }
}

static void property(FILE *to, const char *name, double value)
{
    if (isfinite(value))
        fprintf(to, "   <property name=\"%s\" value=\"%.17g\"/>\n", name, value);
}

static void property_omitted(FILE *to, const sweep_point *p)
{
    char words[SCENE_OMISSION_WORDS] = "";
    if (p->status == STATUS_OK)
        scene_omission_words(features_omitted(&p->scene), words);
    if (words[0] != '\0')
        fprintf(to, "   <property name=\"omitted\" value=\"%s\"/>\n", words);
    assumption a;
    for (int i = 0; assumptions_at(p, i, &a); i++) {
        fputs("   <property name=\"", to);
        escaped(to, assumptions_kind(a.kind));
        fputs("\" value=\"", to);
        escaped(to, a.text);
        fputs("\"/>\n", to);
    }
}

static double seconds_of(const series *one)
{
    double seconds = 0;
    for (int i = 0; i < one->meshes; i++)
        seconds += one->cell[i].solve.seconds_setup + one->cell[i].solve.seconds_solve;
    return seconds;
}

static void open_test(FILE *to, const sweep_point *p)
{
    fprintf(to, "  <testcase classname=\"%s.", p->type->name);
    escaped(to, p->text[0] != '\0' ? p->text : "default");
}

/* Returns 1 if the verdict is skipped as expected. An unexpected skip counts as a failure. */
static int is_skipped(const verdict *v)
{
    return (v->kind == VERDICT_SKIP || v->kind == VERDICT_OTHER_MODEL) && v->matches;
}

static void write_verdict(FILE *to, const sweep *s, const verdict *v)
{
    const series *one = &s->series[v->series];
    const sweep_point *p = &s->point[one->point];
    open_test(to, p);
    fprintf(to, "\" name=\"%s %s\" time=\"%.6f\">\n   <properties>\n", one->formulation.key,
            p->scene.quantity[v->quantity].name, seconds_of(one));
    property(to, "value", v->finest);
    property(to, "limit", v->fit.limit);
    property(to, "order", v->fit.order);
    property(to, "truth", v->truth != NULL ? v->truth->value : NAN);
    property(to, "error", v->error);
    property(to, "model_error", v->model_error);
    property(to, "tolerance", v->tolerance);
    property_omitted(to, p);
    fprintf(to, "   </properties>\n");
    if (is_skipped(v)) {
        fprintf(to, "   <skipped message=\"");
        escaped(to, v->reason);
        fprintf(to, "\"/>\n");
    } else if (!v->matches) {
        char sentence[2 * FAULT_TEXT];
        sentence_of_verdict(v, p->scene.quantity[v->quantity].least_order, sentence,
                            sizeof sentence);
        fprintf(to, "   <failure message=\"");
        escaped(to, sentence);
        fprintf(to, "; expected %s\"/>\n",
                v->expected < VERDICT_KINDS ? verdict_name(v->expected) : "another verdict");
    }
    fprintf(to, "  </testcase>\n");
}

static void write_agreement(FILE *to, const sweep *s, const agreement *a)
{
    const series *one = &s->series[a->series];
    const sweep_point *p = &s->point[one->point];
    open_test(to, p);
    fprintf(to, "\" name=\"%s n=%d %s (discrete)\">\n", one->formulation.key, one->mesh[a->mesh],
            p->scene.quantity[a->quantity].name);
    if (!a->good)
        fprintf(to, "   <failure message=\"%.17g differs from the stored value %.17g\"/>\n",
                a->value, a->truth->value);
    fprintf(to, "  </testcase>\n");
}

typedef struct junit_counts {
    int tests, failures, skipped;
} junit_counts;

static junit_counts count_all(const sweep *s, const evaluation *j)
{
    const int nothing = evaluation_exit(j) == EVALUATION_NOTHING;
    junit_counts c = {.tests = j->verdicts + j->agreements + j->breaches + j->regressions + 3 +
                               nothing + (s->unfinished > 0),
                      .failures = j->breaches + j->regressions + nothing + (j->unobserved > 0) +
                                  (j->unmet > 0) + (j->flaws > 0) + (s->unfinished > 0)};
    for (int i = 0; i < j->verdicts; i++) {
        c.skipped += is_skipped(&j->verdict[i]);
        c.failures += !j->verdict[i].matches;
    }
    for (int i = 0; i < j->agreements; i++)
        c.failures += !j->agreement[i].good;
    return c;
}

static void write_deviations(FILE *to, const char *name, int failures, const char *what)
{
    fprintf(to, "  <testcase classname=\"ledger\" name=\"%s\">\n", name);
    if (failures > 0)
        fprintf(to, "   <failure message=\"%d %s\"/>\n", failures, what);
    fprintf(to, "  </testcase>\n");
}

static void write_failed(FILE *to, const char *class, const char *name, const char *why)
{
    fprintf(to, "  <testcase classname=\"%s\" name=\"", class);
    escaped(to, name);
    fputs("\">\n   <failure message=\"", to);
    escaped(to, why);
    fprintf(to, "\"/>\n  </testcase>\n");
}

void junit_write(FILE *to, const sweep *s, const evaluation *j)
{
    const junit_counts c = count_all(s, j);
    fprintf(to,
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n <testsuite "
            "name=\"beamwork\" tests=\"%d\" failures=\"%d\" "
            "skipped=\"%d\">\n",
            c.tests, c.failures, c.skipped);
    for (int i = 0; i < j->verdicts; i++)
        write_verdict(to, s, &j->verdict[i]);
    for (int i = 0; i < j->agreements; i++)
        write_agreement(to, s, &j->agreement[i]);
    for (int i = 0; i < j->breaches; i++)
        write_failed(to, "contract", j->breach[i].formulation, j->breach[i].why);
    for (int i = 0; i < j->regressions; i++)
        write_failed(to, "not-worse-than", j->regression[i].of, j->regression[i].why);
    write_deviations(to, "findings", j->unobserved,
                     j->unobserved == 1 ? "known deviation was not observed"
                                        : "known deviations were not observed");
    write_deviations(to, "truths", j->unmet,
                     j->unmet == 1 ? "reference value refers to an unknown name"
                                   : "reference values refer to unknown names");
    write_deviations(to, "cells", j->flaws,
                     j->flaws == 1 ? "inconsistent run record" : "inconsistent run records");
    if (evaluation_exit(j) == EVALUATION_NOTHING)
        write_deviations(to, "run", 1,
                         "run assigned no verdict, because there is no reference value");
    if (s->unfinished > 0)
        write_deviations(to, "run", s->unfinished,
                         s->partial ? "missing runs, because batches are missing"
                                    : "missing runs, because verify was interrupted");
    fprintf(to, " </testsuite>\n</testsuites>\n");
}

const char *assumptions_kind(int kind)
{
    static const char *const names[] = {
        [ASSUMPTION_NOT_KNOWN] = "not known", [ASSUMPTION_NOT_MODELLED] = "not modelled"};
    return kind >= 0 && kind < ASSUMPTION_KINDS ? names[kind] : "";
}

/* Returns 1 if the section has an assumption of this kind, and sets its text. */
static int of_section(const scene *s, assumption *a)
{
    const scene_words name = scene_name(s, SCENE_SECTIONS, a->section);
    a->physics[0] = '\0';
    if (a->kind == ASSUMPTION_NOT_MODELLED) {
        snprintf(a->text, sizeof a->text,
                 "the effect of the bimoment on the torsion of section %s (int omega r^2 dA is not "
                 "zero): if warping is restrained, twists in opposite directions differ",
                 name.text);
        return features_one_sided(s, a->section);
    }
    scene_omission_words(features_not_given(s, a->section), a->physics);
    snprintf(a->text, sizeof a->text,
             "%s of section %s is not given by its constants and is assumed to be zero", a->physics,
             name.text);
    return a->physics[0] != '\0';
}

int assumptions_at(const sweep_point *p, int index, assumption *out)
{
    int found = 0;
    if (p->type->file == NULL || p->status != STATUS_OK)
        return 0;
    for (int i = 0; i < p->scene.sections; i++)
        for (int kind = 0; kind < ASSUMPTION_KINDS; kind++) {
            out->section = i;
            out->kind = (assumption_kind)kind;
            if (of_section(&p->scene, out) && found++ == index)
                return 1;
        }
    return 0;
}

void assumptions_words(const sweep_point *p, size_t size, char out[])
{
    const size_t rest = 40;
    size_t used = 0;
    int left = 0;
    assumption a;
    out[0] = '\0';
    for (int i = 0; assumptions_at(p, i, &a); i++) {
        const char *kind = assumptions_kind(a.kind), *between = i > 0 ? "; " : "";
        const size_t more = strlen(between) + strlen(kind) + 2 + strlen(a.text);
        if (left > 0 || used + more + rest > size) {
            left++;
            continue;
        }
        snprintf(out + used, size - used, "%s%s: %s", between, kind, a.text);
        used += more;
    }
    if (left > 0 && size > used)
        snprintf(out + used, size - used, "; and %d more", left);
}
