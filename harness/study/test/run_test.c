/* Tests of parameters, names, selections and reference values, and of how numbers are printed. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "elements/test/kit.h"
#include "harness/formulations/formulations.h"
#include "harness/study/study.h"

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
                 strstr(f.text, "beamw has no option 'newtn'; did you mean 'newton'?") == NULL,
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
    gsl_test(truths_read(real, &t, &f) != STATUS_OK, "the packed reference values are read (%s)",
             f.text);
    double value[CASE_MAX_PARAMETERS];
    const case_type *c = case_find("c_column", &f);
    parameters_default(c, value);
    const truth *row = truth_of(&t, c, value, "buckling_load", "same");
    gsl_test(row == NULL, "the column has a reference value");
    if (row != NULL)
        gsl_test_rel(row->value, 11942676.75772, 1e-12, "and it is exact before published");
    truths_free(&t);
}

static void run_tests(void)
{
    parameters();
    hashes_of_neighbours();
    texts();
    meshes();
    random_input();
    truth_files();
}

/* Makes a scene of size 5 m, with E = 2e11 Pa and A = 0.02 m^2. */
static void make(scene *s)
{
    const double y[3] = {0, 0, 1};
    const section_spec spec = section_spec_rectangle(2e11, 8e10, 0.2, 0.1);
    scene_init(s, "size");
    scene_add_section(s, &spec);
    scene_add_node(s, 1, 2, 0.5);
    scene_add_node(s, 4, 6, 0.5);
    scene_add_member(s, 0, 1, 0, y);
}

static void change_tests(void)
{
    const double size = 5, young = 2e11, EA = young * 0.02, force = 1e-14 * EA;
    const struct {
        const char *name;
        scene_extract what;
        double scale;
    } row[] = {
        {"displacement", scene_coordinate(1, SCENE_UY), 1e-12 * size},
        {"rotation", scene_coordinate(1, SCENE_RY), 1e-12},
        {"relative displacement", scene_relative_to(1, SCENE_UX, 0), 1e-12 * size},
        {"relative rotation", scene_relative_to(1, SCENE_RZ, 0), 1e-12},
        {"reaction", scene_reaction(0, SCENE_UZ), force},
        {"reacting moment", scene_reaction(0, SCENE_RX), force * size},
        {"N", scene_internal_at(0, 0.5, SCENE_N), force},
        {"Qz", scene_internal_at(0, 0.5, SCENE_QZ), force},
        {"Mx", scene_internal_at(0, 0.5, SCENE_MX), force * size},
        {"bimoment", scene_internal_at(0, 0.5, SCENE_BIMOMENT), force * size * size},
        {"stress", scene_stress_at(0, 0.5, SCENE_VON_MISES), 1e-14 * young},
        {"du/dF", scene_compliance_entry(SCENE_UX, SCENE_UY), 1e-12 * size / EA},
        {"du/dM", scene_compliance_entry(SCENE_UX, SCENE_RY), 1e-12 / EA},
        {"dr/dF", scene_compliance_entry(SCENE_RX, SCENE_UY), 1e-12 / EA},
        {"dr/dM", scene_compliance_entry(SCENE_RX, SCENE_RY), 1e-12 / size / EA},
        {"orientation", scene_orientation_entry(1, 0, 2), 1e-12},
    };
    enum { ROWS = sizeof row / sizeof *row };
    scene s;
    quantity_result value[ROWS] = {{0}};
    make(&s);
    for (int i = 0; i < ROWS; i++) {
        char unit[8];
        snprintf(unit, sizeof unit, "%d", i);
        scene_add_quantity(&s, row[i].name, unit, 0, row[i].what)->factor = i % 2 ? -1 : 10;
    }
    const solve_result r = {.quantities = ROWS, .quantity = value};
    for (int i = 0; i < ROWS; i++)
        gsl_test_rel(change_scale(&s, i, &r), (i % 2 ? 1 : 10) * row[i].scale, 1e-13, "%s",
                     row[i].name);
    value[0].value = -3;
    gsl_test_rel(change_scale(&s, 0, &r), 3e-9, 1e-13, "beside a value of its unit");
    s.quantity[0].near_zero = 7;
    gsl_test_rel(change_scale(&s, 0, &r), 7, 1e-13, "beside what the case says");
    scene_free(&s);
}

static void output(const char *text, const char *expected, const char *what)
{
    gsl_test(strcmp(text, expected) != 0, "%s: '%s', should be '%s'", what, text, expected);
}

static void known(double value, double uncertainty, const char *expected)
{
    char text[ROUNDING_TEXT];
    rounding_known(value, uncertainty, text);
    output(text, expected, "a value and its uncertainty");
}

static void percent(double error, const char *expected)
{
    char text[ROUNDING_TEXT];
    rounding_percent(error, text);
    output(text, expected, "an error");
    gsl_test(strlen(text) > 11, "'%s' is no wider than its column", text);
}

static void every_size(void)
{
    for (int size = -12; size <= 12; size++)
        for (int digits = 2; digits <= 9; digits++) {
            const double value = -1.234567891234 * pow(10, size);
            const double uncertainty = 5.5 * pow(10, size - digits);
            char text[ROUNDING_TEXT];
            rounding_known(value, uncertainty, text);
            const double apart = fabs(strtod(text, NULL) - value);
            gsl_test(apart > 0.1 * uncertainty, "%s +- %g is %.15g", text, uncertainty, value);
            int shown = 0;
            for (const char *c = text; *c != '\0' && *c != 'e'; c++)
                shown += *c >= (shown > 0 ? '0' : '1') && *c <= '9';
            gsl_test(size - digits < 0 && shown > digits + 2, "%s has more than is known", text);
        }
}

static void rounding_tests(void)
{
    known(692531.6261914, 4.43, "692531.6");
    known(692531.6261914, 443, "692530");
    known(12858745.04, 0.31, "12858745.04");
    known(1.2345678e-8, 3e-12, "1.23457e-8");
    known(-0.00123456, 1e-6, "-0.0012346");
    known(99.9996, 0.01, "100.00");
    known(2.5, 0, "2.5");
    known(3, INFINITY, "3.000000");
    known(5, 80, "5");
    known(0, 1e-9, "0");
    known(NAN, 1, "-");
    known(-0.0001234567890123, 0, "-0.00012345678901");
    known(-0.0001234567890123, 1e-20, "-1.2345678901e-4");
    percent(-0.027801, "-2.7801 %");
    percent(2.1e-11, "+2.1e-9 %");
    percent(-9.99999e-5, "-1.0e-2 %");
    percent(12.34567, "+1234.6 %");
    percent(-1e9, "-1.0e11 %");
    percent(0, "0 %");
    percent(INFINITY, "-");
    every_size();
}

/* Returns the text of the progress display, which the caller frees. */
static char *shown(double now, int done, double share, int ends)
{
    char *text = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    progress p = progress_begin(to, "cells", 40, 1000);
    progress_show(&p, now, done, share, "case, beam, n = 8");
    if (ends)
        progress_end(&p);
    fclose(to);
    return text;
}

static void progress_shows(double seconds, double share, const char *expected)
{
    char *text = shown(1000 + seconds, 10, share, 0);
    gsl_test(strcmp(text, expected) != 0, "says '%s', should say '%s'", text, expected);
    free(text);
}

static void the_end(void)
{
    char *text = shown(1010, 10, 0.5, 1);
    char *last = strrchr(text, '\r');
    gsl_test(last[1] != '\0', "the cursor stands at the beginning");
    *last = '\0';
    last = strrchr(text, '\r') + 1;
    const size_t blanks = strspn(last, " ");
    gsl_test(last[blanks] != '\0' || blanks < 20, "%d blanks are written over it", (int)blanks);
    gsl_test(strchr(text, '\033') != NULL, "no escape sequence");
    free(text);
}

static void too_long(void)
{
    char *text = NULL, name[200];
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    progress p = progress_begin(to, "cells", 40, 1000);
    memset(name, 'x', sizeof name);
    name[sizeof name - 1] = '\0';
    progress_show(&p, 1001, 1, 0.5, name);
    fclose(to);
    gsl_test_int((int)strlen(text), 81, "a line and two returns");
    free(text);
}

static void progress_tests(void)
{
    progress_shows(30, 0.25, "\rcells 10 of 40, 25 %, about 2 min left: case, beam, n = 8\r");
    progress_shows(30, 0.5, "\rcells 10 of 40, 50 %, about 30 s left: case, beam, n = 8\r");
    progress_shows(60, 0.01, "\rcells 10 of 40, 1 %, about 1 h 39 min left: case, beam, n = 8\r");
    progress_shows(0.5, 0.5, "\rcells 10 of 40, 50 %: case, beam, n = 8\r");
    progress_shows(30, 0.001, "\rcells 10 of 40, 0 %: case, beam, n = 8\r");
    the_end();
    too_long();
    progress quiet = progress_begin(NULL, "cells", 40, 0);
    gsl_test(progress_is_due(&quiet, 1e9), "nothing is due where nothing is said");
    progress_show(&quiet, 1, 1, 1, "nothing");
    progress_end(&quiet);
    progress loud = progress_begin(stderr, "cells", 40, 1000);
    gsl_test(progress_is_due(&loud, 1000.05), "not every moment");
    gsl_test(!progress_is_due(&loud, 1001), "but every second");
}

int main(void)
{
    run_tests();
    change_tests();
    rounding_tests();
    progress_tests();
    return gsl_test_summary();
}
