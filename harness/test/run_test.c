/* Parameters, names, convergence, selection, truths. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness/run/convergence.h"
#include "harness/run/formulations.h"
#include "harness/run/sweep.h"

static void parameters(void)
{
    fault f;
    const case_type *c = case_find("c_column", &f);
    double value[CASE_MAX_PARAMETERS], other[CASE_MAX_PARAMETERS];
    int any[CASE_MAX_PARAMETERS];
    char text[PARAMETERS_TEXT];
    parameters_default(c, value);
    gsl_test(parameters_set(c, "length=7.25", value, &f) != STATUS_OK, "a parameter is set");
    gsl_test(parameters_set(c, "section_data=printed", value, &f) != STATUS_OK, "a choice is set");
    static const char *const bad[] = {"length=-1", "length=nan",           "length=inf", "length=", "length",
                                      "lengthh=1", "section_data=painted", "shear=0.5",  "=3",      ""};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        gsl_test(parameters_set(c, bad[i], value, &f) != STATUS_REFUSED || strchr(f.text, '\n') != NULL, "'%s' is refused: %s",
                 bad[i], f.text);
    parameters_text(c, value, text, sizeof text);
    gsl_test(strcmp(text, "length=7.25;section_data=printed") != 0, "text of a point: %s", text);
    gsl_test(parameters_parse(c, text, other, any, &f) != STATUS_OK ||
                 parameters_hash(c, value, NULL) != parameters_hash(c, other, any),
             "text and hash agree");
    gsl_test(parameters_hash(c, value, NULL) == 0, "hash");
    gsl_test(case_find("c_colum", &f) != NULL || strstr(f.text, "'c_column'") == NULL, "nearest case: %s", f.text);
    formulation chosen;
    gsl_test(formulation_parse("beamw:mass=consistent", &chosen, &f) != STATUS_OK || strcmp(chosen.key, "beamw") != 0,
             "a default option is not in the key");
    gsl_test(formulation_parse("beamw:mass=lumped", &chosen, &f) != STATUS_OK || strcmp(chosen.key, "beamw:mass=lumped") != 0,
             "another is");
    gsl_test(formulation_parse("beamw:mass=heavy", &chosen, &f) != STATUS_REFUSED, "refused: %s", f.text);
    gsl_test(formulation_parse("beamv", &chosen, &f) != STATUS_REFUSED || strstr(f.text, "beamw") == NULL, "refused: %s", f.text);
}

static void convergences(void)
{
    const int n[] = {2, 4, 8, 16, 32};
    double value[5];
    for (int i = 0; i < 5; i++)
        value[i] = 3 + 0.7 * pow(n[i], -2.5);
    convergence c = convergence_of(5, n, value, 3);
    gsl_test(c.kind != CONVERGENCE_ORDERLY, "orderly");
    gsl_test_rel(c.order, 2.5, 1e-6, "order");
    gsl_test_rel(c.limit, 3, 1e-10, "limit");
    for (int i = 0; i < 5; i++)
        value[i] = 3 + pow(n[i], -12.0);
    c = convergence_of(5, n, value, 3);
    gsl_test(c.kind != CONVERGENCE_FLOOR, "the round-off floor is recognised");
    gsl_test_rel(c.limit, 3, 1e-12, "limit at the floor");
    for (int i = 0; i < 5; i++)
        value[i] = 3 + (i % 2 ? 0.1 : -0.1) / n[i];
    gsl_test(convergence_of(5, n, value, 3).kind != CONVERGENCE_NONE, "alternating values show no order");
    gsl_test(convergence_of(2, n, value, 3).kind != CONVERGENCE_NONE, "two meshes show no order");
    const int uneven[] = {1, 3, 4, 20};
    for (int i = 0; i < 4; i++)
        value[i] = -5 + 2 * pow(uneven[i], -4.0);
    c = convergence_of(4, uneven, value, 5);
    gsl_test_rel(c.order, 4, 1e-6, "order on uneven meshes");
}

static void selection(void)
{
    const char *text = "c_column/default/beamw";
    gsl_test_int(select_matches("c_column", text), 1, "word");
    gsl_test_int(select_matches("c_column and not beamw", text), 0, "and, not");
    gsl_test_int(select_matches("hexapod or beamw", text), 1, "or");
    gsl_test_int(select_matches("c_column beamw", text), 1, "side by side is and");
    gsl_test_int(select_matches("and", text), -1, "malformed");
    gsl_test_int(select_matches("c_column or", text), -1, "malformed");
    gsl_test_int(select_matches("", text), -1, "empty");
}

static void truth_files(void)
{
    truths t;
    fault f;
    char path[] = "/tmp/beamwork-test-XXXXXX";
    const int file = mkstemp(path);
    gsl_test(truths_read("/nowhere/truths.h5", &t, &f) != STATUS_FAULT, "missing: %s", f.text);
    gsl_test(file < 0 || write(file, "this is not HDF5", 16) != 16, "file written");
    close(file);
    gsl_test(truths_read(path, &t, &f) != STATUS_FAULT || strchr(f.text, '\n') != NULL, "foreign: %s", f.text);
    unlink(path);
    const char *real = getenv("BEAMWORK_TRUTHS");
    if (real == NULL)
        return;
    gsl_test(truths_read(real, &t, &f) != STATUS_OK, "the packed truths are read (%s)", f.text);
    double value[CASE_MAX_PARAMETERS];
    const case_type *c = case_find("c_column", &f);
    parameters_default(c, value);
    const truth *row = truth_of(&t, c, value, "buckling_load", "same");
    gsl_test(row == NULL, "the column has a truth");
    if (row != NULL)
        gsl_test_rel(row->value, 11942676.75772, 1e-12, "and it is exact before published");
    truths_free(&t);
}

int main(void)
{
    parameters();
    convergences();
    selection();
    truth_files();
    return gsl_test_summary();
}
