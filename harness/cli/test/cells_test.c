/* Series as bytes: reading them back, truncated input, and the parts that the digest excludes. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elements/shared/choice.h"
#include "harness/cli/cli_impl.h"
#include "harness/experiments/experiments.h"
#include "harness/formulations/formulations.h"
#include "harness/records/records.h"
#include "harness/study/study.h"

static void make(sweep *s)
{
    static const int mesh[] = {1, 2};
    const sweep_request request = {.jobs = 1};
    double value[CASE_MAX_PARAMETERS];
    formulation chosen;
    fault f = {""};
    const case_type *type = case_find("sheet_cantilever", &f);
    parameters_default(type, value);
    gsl_test(formulation_parse("beamw", &chosen, &f) != STATUS_OK ||
                 plan_one(type, value, &chosen, 1, mesh, 2, s, &f) != STATUS_OK ||
                 run_sweep(&request, s, &f) != STATUS_OK,
             "two cells: %s", f.text);
    series *one = &s->series[0];
    one->noise = calloc((size_t)s->point[0].scene.quantities, sizeof *one->noise);
    one->timing = calloc(2, sizeof *one->timing);
    one->noise[0] = 1e-9;
    one->timing[1].as_is.repeats = 7;
}

typedef struct bytes {
    char *at;
    size_t size;
    char digest[DIGEST_TEXT];
} bytes;

static bytes written(const sweep *s)
{
    bytes out;
    fault f = {""};
    digest content = digest_begin();
    FILE *to = open_memstream(&out.at, &out.size);
    gsl_test(cells_write(to, s, 0, &content, &f) != STATUS_OK, "%s", f.text);
    fclose(to);
    digest_text(&content, out.digest);
    return out;
}

static status read_back(const bytes *b, size_t size, sweep *s)
{
    fault f = {""};
    FILE *from = size > 0 ? fmemopen(b->at, size, "rb") : fopen("/dev/null", "rb");
    cells_free_results(&s->series[0]);
    const status outcome = cells_read(from, s, 0, &f);
    fclose(from);
    return outcome;
}

static void round_trip(sweep *s)
{
    const bytes before = written(s);
    gsl_test(read_back(&before, before.size, s) != STATUS_OK, "read back");
    const bytes after = written(s);
    gsl_test(strcmp(before.digest, after.digest) != 0, "the same values");
    gsl_test(s->series[0].noise[0] != 1e-9 || s->series[0].timing[1].as_is.repeats != 7,
             "noise and times come back");
    for (size_t size = 0; size < before.size; size += 1 + before.size / 997)
        gsl_test(read_back(&before, size, s) != STATUS_FAULT, "cut after %zu bytes", size);
    gsl_test(read_back(&before, before.size, s) != STATUS_OK, "read back again");
    free(before.at);
    free(after.at);
}

static int differs(const sweep *s, const char *before)
{
    const bytes now = written(s);
    const int out = strcmp(now.digest, before) != 0;
    free(now.at);
    return out;
}

static void digests(sweep *s)
{
    series *one = &s->series[0];
    solve_result *r = &one->cell[1].solve;
    const bytes before = written(s);
    r->seconds_solve *= 2;
    r->seconds_setup += 1;
    one->timing[0].as_is.solve = 1;
    gsl_test(differs(s, before.digest), "times are left out");
    int curves = 0;
    for (int q = 0; q < r->quantities; q++) {
        quantity_result *of = &r->quantity[q];
        double *number = of->curve.points > 0 ? &of->curve.value[of->curve.points - 1] : &of->value;
        const double kept = *number;
        *number = isfinite(kept) ? nextafter(kept, INFINITY) : 1;
        gsl_test(!differs(s, before.digest), "quantity %d counts", q);
        *number = kept;
        curves += of->curve.points > 0;
    }
    gsl_test(curves == 0, "curves are among them");
    one->noise[0] *= 2;
    gsl_test(!differs(s, before.digest), "noise counts");
    one->noise[0] /= 2;
    one->cell[0].counters.iterations++;
    gsl_test(!differs(s, before.digest), "work counts");
    one->cell[0].counters.iterations--;
    one->cell[0].solve.status = STATUS_NOT_CONVERGED;
    gsl_test(!differs(s, before.digest), "how it ended counts");
    one->cell[0].solve.status = STATUS_OK;
    gsl_test(differs(s, before.digest), "all is as before");
    free(before.at);
}

static void kept(sweep *s)
{
    static const char none[] = {0};
    cells_keep(s, none);
    gsl_test(s->seriess != 0 || s->unfinished != 2, "two cells are missing");
}

static void cells_tests(void)
{
    sweep s;
    make(&s);
    round_trip(&s);
    digests(&s);
    kept(&s);
    sweep_free(&s);
}

static void written_as(const char *text, const char *wanted, const char *what)
{
    char *got = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&got, &size);
    roff_text(to, text);
    fclose(to);
    gsl_test(strcmp(got, wanted) != 0, "%s: %s", what, got);
    free(got);
}

static void roff_tests(void)
{
    written_as(".partial", "\\&.partial\n", "no request");
    written_as("'quoted' \"and\"", "\\(aqquoted\\(aq \\(dqand\\(dq\n", "quotes stay straight");
    written_as("--set a^2 ~ `b` c\\d", "\\-\\-set a\\(ha2 \\(ti \\(gab\\(ga c\\ed\n", "as typed");
    written_as("One. Two\n three.", "One.\nTwo three.\n", "a sentence begins a line");
    written_as("", "\n", "nothing");
    written_as("aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa bbbbbbb .c",
               "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa bbbbbbb\n"
               "\\&.c\n",
               "78 columns");
}

static glossary words;

static void explained(const char *what, const char *word)
{
    gsl_test(glossary_find(&words, word) == NULL, "%s '%s'", what, word);
}

static void all_of(const char *what, const char *choices)
{
    char word[GLOSSARY_WORD];
    for (int i = 0; glossary_part(choices, i, word); i++)
        explained(what, word);
}

static void words_tests(void)
{
    const char *packed = getenv("BEAMWORK_TRUTHS");
    fault f = {""};
    gsl_test(glossary_read(packed != NULL ? packed : "build/truths.h5", &words, &f) != STATUS_OK,
             "the glossary is read %s", f.text);
    for (int i = 0; i < VERDICT_KINDS; i++)
        explained("verdict", verdict_name((verdict_kind)i));
    for (int i = 1; i < LIMIT_KINDS; i++)
        explained("kind of limit", limit_kind_name((limit_kind)i));
    for (int i = 0; i <= STATUS_NO_VALUE; i++)
        explained("status", status_name((status)i));
    for (int i = 0; i < OUTCOME_KINDS; i++)
        explained("outcome", outcome_name((outcome_kind)i));
    for (unsigned bit = 1; bit < FEATURE_END; bit <<= 1)
        explained("feature", feature_name(bit));
    for (int i = 0; i <= SCENE_ROTATION; i++)
        explained("analysis", scene_analysis_name((scene_analysis_kind)i));
    for (int i = 0; i < COMPARISON_KINDS; i++)
        explained("change", comparison_kind_names[i]);
    for (int i = 0; i <= AGAINST_SLOWER; i++)
        explained("comparison of times", against_name((against_outcome)i));
    all_of("kind of truth", truth_kinds);
    all_of("theory of shear", SCENE_SHEAR_THEORIES);
    all_of("moment convention", SCENE_MOMENTS_CHOICES);
    all_of("model", "same|other");
    all_of("group of analyses", "statics|vibration|buckling");
    glossary_free(&words);
}

int main(void)
{
    cells_tests();
    roff_tests();
    words_tests();
    return gsl_test_summary();
}
