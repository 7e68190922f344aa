/* Parameters, names, selection, truths. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "elements/test/random.h"
#include "harness/formulations/formulations.h"
#include "harness/study/study.h"

/* Points one behind the other have the hash that each has alone. */
static void hashes_of_neighbours(void)
{
    fault f;
    const case_type *c = case_find("c_column", &f);
    static const char *const text[] = {"",  "length=3", "length=3;section_data=printed",
                                       "*", "length=*", "length=7;section_data=printed"};
    parameters_words before;
    before.known = 0;
    for (size_t i = 0; i < sizeof text / sizeof text[0]; i++) {
        double value[CASE_MAX_PARAMETERS];
        int any[CASE_MAX_PARAMETERS];
        gsl_test(parameters_parse(c, text[i], value, any, &f) != STATUS_OK, "'%s'", text[i]);
        gsl_test(parameters_hash_next(c, value, any, &before) != parameters_hash(c, value, any),
                 "hash of '%s' behind its neighbour", text[i]);
    }
}

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
    static const char *const bad[] = {
        "length=-1", "length=nan",           "length=inf", "length=", "length",
        "lengthh=1", "section_data=painted", "shear=0.5",  "=3",      ""};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        gsl_test(parameters_set(c, bad[i], value, &f) != STATUS_REFUSED ||
                     strchr(f.text, '\n') != NULL,
                 "'%s' is refused: %s", bad[i], f.text);
    parameters_text(c, value, text, sizeof text);
    gsl_test(strcmp(text, "length=7.25;section_data=printed") != 0, "text of a point: %s", text);
    gsl_test(parameters_parse(c, text, other, any, &f) != STATUS_OK ||
                 parameters_hash(c, value, NULL) != parameters_hash(c, other, any),
             "text and hash agree");
    gsl_test(parameters_hash(c, value, NULL) == 0, "hash");
    gsl_test(case_find("c_colum", &f) != NULL || strstr(f.text, "'c_column'") == NULL,
             "nearest case: %s", f.text);
    gsl_test(parameters_parse(c, "length=2;length=3", other, NULL, &f) != STATUS_REFUSED ||
                 strstr(f.text, "length of c_column is given twice") == NULL,
             "one value each: %s", f.text);
    formulation chosen;
    gsl_test(formulation_parse("beamw:newtn=dense", &chosen, &f) != STATUS_REFUSED ||
                 strstr(f.text, "beamw has no option 'newtn', did you mean 'newton'?") == NULL,
             "an option that all take is known: %s", f.text);
    gsl_test(formulation_parse("beamw:newton=mixed,newton=dense", &chosen, &f) != STATUS_REFUSED ||
                 strstr(f.text, "newton of beamw is given twice") == NULL,
             "one value each: %s", f.text);
    gsl_test(formulation_parse("beamw:mass=consistent", &chosen, &f) != STATUS_OK ||
                 strcmp(chosen.key, "beamw") != 0,
             "a default option is not in the key");
    gsl_test(formulation_parse("beamw:mass=lumped", &chosen, &f) != STATUS_OK ||
                 strcmp(chosen.key, "beamw:mass=lumped") != 0,
             "another is");
    gsl_test(formulation_parse("beamw:mass=heavy", &chosen, &f) != STATUS_REFUSED, "refused: %s",
             f.text);
    gsl_test(formulation_parse("beamv", &chosen, &f) != STATUS_REFUSED ||
                 strstr(f.text, "beamw") == NULL,
             "refused: %s", f.text);
}

/* Any value comes back from its text; so do names of formulations with every option changed. */
static void texts(void)
{
    static const double value[] = {1.0 / 3, 0.1 + 0.2, 1e-300, 123456789.123456789,
                                   2e22,    1 - 1e-16};
    static const parameter_type any = {"any", "", 0, -1e300, 1e300, NULL, "any number"};
    char text[64];
    for (size_t i = 0; i < sizeof value / sizeof value[0]; i++) {
        assignment_value_text(&any, value[i], text, sizeof text);
        gsl_test(strtod(text, NULL) != value[i], "%.17g comes back from '%s'", value[i], text);
    }
    static const char *const name[] = {
        "beamw:mass=lumped,newton=dense", "geometrically_exact:nodes=2,newton=displacement",
        "beamw_consistent:mass=lumped,torsion=hyperbolic,newton=displacement"};
    for (size_t i = 0; i < sizeof name / sizeof name[0]; i++) {
        formulation given, again;
        fault f = {""};
        gsl_test(formulation_parse(name[i], &given, &f) != STATUS_OK, "%s: %s", name[i], f.text);
        gsl_test(formulation_parse(given.key, &again, &f) != STATUS_OK ||
                     memcmp(given.option, again.option, sizeof given.option) != 0,
                 "%s comes back from %s", name[i], given.key);
    }
}

/* Meshes of a series are in order, each once, however they are given. */
static void meshes(void)
{
    static const int given[] = {8, 1, 4, 8, 2, 1}, right[] = {1, 2, 4, 8};
    sweep s;
    formulation chosen;
    double value[CASE_MAX_PARAMETERS];
    fault f = {""};
    const case_type *type = case_find("elastica", &f);
    parameters_default(type, value);
    gsl_test(formulation_parse("beamw", &chosen, &f) != STATUS_OK, "%s", f.text);
    gsl_test(plan_one(type, value, &chosen, 1, given, 6, &s, &f) != STATUS_OK, "%s", f.text);
    gsl_test_int(s.series[0].meshes, 4, "meshes that differ");
    gsl_test(memcmp(s.series[0].mesh, right, sizeof right) != 0, "from coarse to fine");
    sweep_free(&s);
}

/* Pieces of right input put together at random: answered or refused in one line, never a crash or
 * another status. */
static void random_input(void)
{
    static const char *const piece[] = {"length",
                                        "=",
                                        ";",
                                        ":",
                                        ",",
                                        "*",
                                        "|",
                                        "-1",
                                        "1e400",
                                        "nan",
                                        "7.25",
                                        "section_data",
                                        "printed",
                                        "beamw",
                                        "mass",
                                        "lumped",
                                        "newton",
                                        "and",
                                        "or",
                                        "not",
                                        " ",
                                        "\t",
                                        "%s%n",
                                        "\xc3\xa4",
                                        "",
                                        "0x1p3",
                                        "a_word_that_is_longer_than_any_buffer_might_expect_it_to_"
                                        "be_in_a_name_of_a_case_or_a_parameter_of_it"};
    const case_type *c = case_find("c_column", NULL);
    uint64_t state = 1;
    int wrong = 0;
    for (int i = 0; i < 20000; i++) {
        char text[2048] = "";
        double value[CASE_MAX_PARAMETERS];
        int any[CASE_MAX_PARAMETERS];
        formulation chosen;
        for (int k = random_below(&state, 12); k > 0; k--)
            strcat(text, piece[random_below(&state, sizeof piece / sizeof piece[0])]);
        fault f[4] = {{""}, {""}, {""}, {""}};
        parameters_default(c, value);
        const status outcome[4] = {parameters_set(c, text, value, &f[0]),
                                   formulation_parse(text, &chosen, &f[1]),
                                   case_find(text, &f[2]) != NULL ? STATUS_OK : STATUS_REFUSED,
                                   parameters_parse(c, text, value, any, &f[3])};
        for (int k = 0; k < 4; k++)
            wrong +=
                outcome[k] != STATUS_OK && (outcome[k] != STATUS_REFUSED || f[k].text[0] == '\0' ||
                                            strchr(f[k].text, '\n') != NULL);
        const int matches = select_matches(text, "c_column/default/beamw/buckling_load");
        wrong += matches < -1 || matches > 1;
        for (int k = 0; k < parameters_count(c); k++)
            wrong += !(value[k] >= (parameter_at(c->parameters, k)->choices != NULL
                                        ? 0
                                        : parameter_at(c->parameters, k)->min));
    }
    gsl_test_int(wrong, 0,
                 "answers to 20000 random inputs that are neither a value nor a clear refusal");
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
    gsl_test(truths_read(path, &t, &f) != STATUS_FAULT || strchr(f.text, '\n') != NULL,
             "foreign: %s", f.text);
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
    hashes_of_neighbours();
    texts();
    meshes();
    random_input();
    truth_files();
    return gsl_test_summary();
}
