/* Tests the values of expressions and ranges, and the positions and remedies in error messages. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/format_impl.h"
#include "elements/math/scalar.h"

static document_node text_node(const char *text)
{
    return (document_node){.kind = DOCUMENT_TEXT, .line = 3, .column = 10, .text = text};
}

static void check_values(const scope *names)
{
    static const struct {
        const char *text;
        double value;
    } all[] = {{"1", 1},
               {"-2.5e-3", -2.5e-3},
               {"1.", 1},
               {".5", 0.5},
               {"1+2*3", 7},
               {"(1+2)*3", 9},
               {"-2^2", -4},
               {"2^-1", 0.5},
               {"2^3^2", 512},
               {"7-2-1", 4},
               {"8/4/2", 1},
               {"--3", 3},
               {"45*deg", 45 * (PI / 180)},
               {"sin(pi/2)", 1},
               {"atan2(1, -1)", 2.356194490192345},
               {"hypot(3,4)", 5},
               {"tanh(log(2))*5", 3},
               {"min(3, 1, 2)", 1},
               {"max(3, 7)", 7},
               {"mod(-1, 4)", 3},
               {"floor(-1.5) + ceil(1.2)", 0},
               {"sign(-3)*abs(-2)", -2},
               {"  length ^ 3 / 12 ", 2.385 * 2.385 * 2.385 / 12},
               {"sqrt(exp(log(16)))", 4}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        mistakes m = {.file = "f"};
        double value = NAN;
        const document_node n = text_node(all[i].text);
        gsl_test(!expression_number(&n, names, &m, &value) || m.count != 0, "'%s' is read",
                 all[i].text);
        gsl_test_abs(value, all[i].value, 1e-14 * fabs(all[i].value), "'%s'", all[i].text);
    }
}

static void check_mistakes(const scope *names)
{
    static const struct {
        const char *text;
        int column;
        const char *message;
    } all[] = {{"", 10, "ends"},
               {"1+", 12, "ends"},
               {"depth/0*/2", 10, "unknown name 'depth'"},
               {"3/1*/2", 14, "'/' where"},
               {"1/(2-2)", 11, "division by zero"},
               {"lenght*2", 10, "did you mean 'length'"},
               {"20 mm", 13, "write 20 mm as 20e-3"},
               {"3pi", 11, "* between factors"},
               {"20e-3m", 15, "numbers have no unit"},
               {"(1+2", 10, "not closed"},
               {"sin(1", 15, "not closed"},
               {"sin 1", 10, "write sin(...)"},
               {"coss(1)", 10, "did you mean 'cos'"},
               {"hypot(1)", 10, "two arguments, not 1"},
               {"sin(1, 2)", 10, "one argument, not 2"},
               {"sqrt(0-1)", 10, "no value"},
               {"(0-8)^0.5", 15, "no value"},
               {"1e999", 10, "too large"},
               {"1e-999", 10, "too small"},
               {"1e300*1e300", 15, "too large"},
               {"1..3", 11, "range"},
               {"1 2", 12, "add an operator"},
               {"corner", 10, "a number is expected"},
               {"__import__(\"os\")", 10, "unknown name '__import__'"},
               {"2*t", 12, "the time t is available only in functions of time"},
               {".", 10, "point has no digits"}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        mistakes m = {.file = "f"};
        double value;
        const document_node n = text_node(all[i].text);
        const int read = expression_number(&n, names, &m, &value);
        gsl_test(read || m.count != 1, "'%s' is one mistake", all[i].text);
        gsl_test_int(m.list[0].column, all[i].column, "'%s': its column", all[i].text);
        gsl_test(strstr(m.list[0].text, all[i].message) == NULL, "'%s': %s", all[i].text,
                 m.list[0].text);
    }
}

static void check_depth(void)
{
    static const char *const repeated[] = {"(", "-", "2^", "abs("};
    for (size_t i = 0; i < sizeof repeated / sizeof repeated[0]; i++) {
        char text[3000] = "";
        const size_t length = strlen(repeated[i]);
        for (size_t k = 0; k + length < sizeof text; k += length)
            memcpy(text + k, repeated[i], length + 1);
        mistakes m = {.file = "f"};
        double value;
        const document_node n = text_node(text);
        gsl_test(expression_number(&n, NULL, &m, &value) || m.count != 1,
                 "hundreds of '%s' are refused", repeated[i]);
    }
}

static void check_ranges(const scope *names)
{
    static const struct {
        const char *text;
        int count;
        double first, last;
    } all[] = {{"0..5", 6, 0, 5},
               {"1..2 step 0.1", 11, 1, 2},
               {"0.25..1 step 0.25", 4, 0.25, 1},
               {"0..1/8", 9, 0, 1},
               {"0..(pi/2)/2", 3, 0, 1.5707963267948966},
               {"0..pi/2 step pi/4", 3, 0, 1.5707963267948966},
               {"3..1 step -1", 3, 3, 1},
               {"0.1..1000/4:log", 5, 0.1, 1000},
               {"-8..-1/3:log", 4, -8, -1},
               {"2..2", 1, 2, 2},
               {"0..length/1", 2, 0, 2.385}};
    static const char *const bad[] = {
        "3..1",     "0..1 step 0", "0..1/0",     "0..1/2.5", "0..1e9", "0..1/2:log", "-1..1/2:log",
        "1..2:log", "1..2/:log",   "1..2/2:lin", "..2",      "1..",    "0..1 step",  "a..b"};
    arena a = {0};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        mistakes m = {.file = "f"};
        double *value;
        const document_node n = text_node(all[i].text);
        const int count = range_values(&n, names, &a, &m, &value);
        gsl_test_int(count, all[i].count, "'%s': how many", all[i].text);
        if (count > 0) {
            gsl_test(value[0] != all[i].first, "'%s' begins there", all[i].text);
            gsl_test(value[count - 1] != all[i].last, "'%s' ends exactly there", all[i].text);
        }
    }
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        mistakes m = {.file = "f"};
        double *value;
        const document_node n = text_node(bad[i]);
        gsl_test(range_values(&n, names, &a, &m, &value) != -1 || m.count == 0, "'%s' is refused",
                 bad[i]);
    }
    arena_free(&a);
}

static void expression_tests(void)
{
    arena a = {0};
    const scope *names = scope_number(NULL, "length", 2.385, &a);
    names = scope_word(names, "corner", "free", &a);
    check_values(names);
    check_mistakes(names);
    check_depth();
    check_ranges(names);
    arena_free(&a);
}

static void check_tree(void)
{
    static const char text[] = "# first\n"
                               "a: 1\n"
                               "b: [x, \"y z\", 'Norway: no']\n"
                               "c:\n"
                               "  d: {e: 1e3, f: no}\n";
    arena a = {0};
    mistakes m = {.file = "f"};
    const document_node *root = document_read(text, sizeof text - 1, &a, &m);
    gsl_test(root == NULL || root->kind != DOCUMENT_MAP || root->count != 3, "a map of three");
    if (root == NULL)
        return;
    const document_node *b = document_find(root, "b"),
                        *d = document_find(document_find(root, "c"), "d");
    gsl_test(b->kind != DOCUMENT_LIST || b->count != 3, "a list of three");
    gsl_test(b->line != 3 || b->column != 4, "the list's place");
    gsl_test(b->item[1]->inset != 1 || strcmp(b->item[1]->text, "y z") != 0, "quotes are no text");
    gsl_test(strcmp(document_find(d, "f")->text, "no") != 0, "no type is guessed");
    gsl_test(document_find(d, "e")->line != 5 || document_find(d, "e")->column != 10,
             "a value's place");
    gsl_test(document_find(root, "z") != NULL, "what is not there");
    arena_free(&a);
}

static void check_refused(void)
{
    static const struct {
        const char *text;
        int line, column;
        const char *message;
    } all[] = {{"", 1, 1, "empty"},
               {"# nothing\n", 2, 1, "empty"},
               {"a: &x 1\n", 1, 4, "anchor"},
               {"a: *x\n", 1, 4, "alias"},
               {"a: !!str 1\n", 1, 4, "tag"},
               {"a: !x {b: 1}\n", 1, 4, "tag"},
               {"a: 1\n<<: {b: 1}\n", 2, 1, "merge key"},
               {"a: 1\n---\nb: 1\n", 2, 1, "second YAML document"},
               {"%YAML 1.1\n---\na: 1\n", 1, 1, "directive"},
               {"a: 1\nb: 2\na: 3\n", 3, 1, "also in line 1"},
               {"{a: 1}: 2\n", 1, 1, "a key must be a name"},
               {"a:\n\tb: 1\n", 2, 1, "a tab"},
               {"a: [1, 2\nb: 3\n", 2, 2, "'['"},
               {"a: {b: [1, 2, c: d}\n", 1, 19, "line 1, column 8"},
               {"a: \"x\\ty\"\n", 1, 4, "control character"},
               {"a: |\n  x\n  y\n", 1, 4, "control character"},
               {"a: \"\\0\"\n", 1, 4, "control character"},
               {"a: \xff\xfe\n", 1, 1, "UTF-8"},
               {"a: [[[[[[[[[[[[[[[[[[1]]]]]]]]]]]]]]]]]]\n", 1, 19, "nested more than"},
               {"a: b: c\n", 1, 5, "correct"}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        arena a = {0};
        mistakes m = {.file = "f"};
        gsl_test(document_read(all[i].text, strlen(all[i].text), &a, &m) != NULL || m.count == 0,
                 "%zu is refused", i);
        gsl_test(m.list[0].line != all[i].line || m.list[0].column != all[i].column,
                 "%zu: %d:%d, not %d:%d", i, m.list[0].line, m.list[0].column, all[i].line,
                 all[i].column);
        gsl_test(strstr(m.list[0].text, all[i].message) == NULL, "%zu: %s", i, m.list[0].text);
        arena_free(&a);
    }
}

static void check_loops(void)
{
    static const char text[] = "n_$i: {for: {i: 0..2}, let: {a: 2*i}, at: [a, i]}\n"
                               "m_${i}x$j: {for: {i: [1, 5], j: [left, right]}, on: n_$i}\n";
    static const char *const expected[] = {"n_0",       "n_1",      "n_2",      "m_1xleft",
                                           "m_1xright", "m_5xleft", "m_5xright"};
    arena a = {0};
    mistakes m = {.file = "f"};
    unrolled *list;
    const document_node *root = document_read(text, sizeof text - 1, &a, &m);
    const int count = unroll_entries(root, NULL, &a, &m, &list);
    gsl_test(count != 7 || m.count != 0, "seven entries: %s", m.list[0].text);
    for (int i = 0; i < count && i < 7; i++)
        gsl_test_str(list[i].name, expected[i], "entry %d", i);
    if (count == 7) {
        gsl_test(scope_find(list[2].names, "a", 1)->number != 4, "a = 2 i");
        gsl_test_str(document_find(list[5].value, "on")->text, "n_5", "a name inside an entry");
    }
    arena_free(&a);
}

static void check_bad_loops(void)
{
    static const struct {
        const char *text;
        int column;
        const char *message;
    } all[] = {{"n_$j: {for: {i: 0..2}}\n", 3, "unknown loop name '$j'"},
               {"n_$i: {for: {i: [0.5, 1]}}\n", 3, "only whole numbers"},
               {"n_$i: {for: 0..2}\n", 13, "for: {i: 0..5}"},
               {"n_$i: {for: {i: 0..99999}}\n", 17, "more than 10000"},
               {"n_$i: {for: {pi: 0..2}}\n", 14, "function or constant"},
               {"n_$i$j: {for: {i: 0..999, j: 0..999}}\n", 1, "loops expand to more than"},
               {"n_$i: {for: {i: 0..2}, let: {i: 3}}\n", 30, "is already defined"},
               {"n_$i: {for: {i: 0..2}, let: {b: 3*x}}\n", 35, "unknown name 'x'"}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        arena a = {0};
        mistakes m = {.file = "f"};
        unrolled *list;
        const document_node *root = document_read(all[i].text, strlen(all[i].text), &a, &m);
        unroll_entries(root, NULL, &a, &m, &list);
        gsl_test_int(m.count, 1, "%s is told once", all[i].text);
        gsl_test_int(m.list[0].column, all[i].column, "%s: column", all[i].text);
        gsl_test(strstr(m.list[0].text, all[i].message) == NULL, "%s: %s", all[i].text,
                 m.list[0].text);
        arena_free(&a);
    }
}

/* At most MISTAKES_MOST errors must be stored, sorted by position. Further errors must only be
 * counted. */
static void check_many(void)
{
    static mistakes m = {.file = "f"};
    for (int i = 30; i > 0; i--)
        mistakes_add(&m, i, 1, "mistake %d", i);
    mistakes_add(&m, 3, 1, "again");
    gsl_test_int(m.count, MISTAKES_MOST, "twenty");
    gsl_test_int(m.more, 10, "and ten");
    gsl_test(m.list[0].line != 1 || m.list[19].line != 20, "the first twenty");
    fault f;
    gsl_test(mistakes_status(&m, &f) != STATUS_REFUSED || strcmp(f.text, "f:1:1: mistake 1") != 0,
             "%s", f.text);
}

static void document_tests(void)
{
    check_tree();
    check_refused();
    check_loops();
    check_bad_loops();
    check_many();
}

static const char *message_of(const char *unit, mistakes *m)
{
    const document_node text = {
        .kind = DOCUMENT_TEXT, .line = 3, .column = 10, .inset = 0, .text = unit};
    *m = (mistakes){.file = "test"};
    units_check(&text, m);
    return m->count > 0 ? m->list[0].text : "";
}

static const struct {
    const char *unit, *si;
    double factor;
} foreign[] = {{"mm", "m", 1e-3},
               {"cm", "m", 1e-2},
               {"km", "m", 1e3},
               {"in", "m", 0.0254},
               {"mm^2", "m^2", 1e-6},
               {"mm^4", "m^4", 1e-12},
               {"kN", "N", 1e3},
               {"MN", "N", 1e6},
               {"kNm", "N m", 1e3},
               {"kN m", "N m", 1e3},
               {"kJ", "J", 1e3},
               {"kW", "W", 1e3},
               {"deg/s", "rad/s", PI / 180},
               {"N mm", "N m", 1e-3},
               {"N/mm", "N/m", 1e3},
               {"kN/m", "N/m", 1e3},
               {"MPa", "Pa", 1e6},
               {"N/mm^2", "Pa", 1e6},
               {"GPa", "Pa", 1e9},
               {"deg", "rad", PI / 180},
               {"degree", "rad", PI / 180},
               {"g", "kg", 1e-3},
               {"t", "kg", 1e3},
               {"ms", "s", 1e-3},
               {"kHz", "Hz", 1e3},
               {"rpm", "rad/s", PI / 30}};

static void remedy_of(const char *unit, const char *si, double factor)
{
    mistakes m;
    const char *text = strstr(message_of(unit, &m), "write ");
    char written[40] = "", taken[40] = "";
    double amount = NAN, value = NAN;
    gsl_test(text == NULL, "%s has a remedy", unit);
    const char *as = text != NULL ? strstr(text, " as ") : NULL,
               *unit_at = text != NULL ? strstr(text, " with unit: ") : NULL;
    gsl_test(as == NULL || unit_at == NULL, "%s: a value and its unit", unit);
    if (as == NULL || unit_at == NULL)
        return;
    sscanf(text, "write %lf", &amount);
    snprintf(written, sizeof written, "%.*s", (int)(unit_at - as - 4), as + 4);
    snprintf(taken, sizeof taken, "%s", unit_at + strlen(" with unit: "));
    mistakes none = {.file = "test"};
    const document_node node = {
        .kind = DOCUMENT_TEXT, .line = 1, .column = 1, .inset = 0, .text = written};
    gsl_test(!expression_number(&node, NULL, &none, &value), "%s: '%s' is a number", unit, written);
    gsl_test(!(fabs(value / (amount * factor) - 1) < 1e-12), "%s: %g of it are %.17g %s", unit,
             amount, value, si);
    gsl_test(strcmp(taken, si) != 0, "%s: in %s", unit, taken);
    gsl_test(message_of(si, &m)[0] != '\0', "%s is taken: %s", si, message_of(si, &m));
}

static void check_si(void)
{
    static const char *const taken[] = {"1",     "J",        "W",     "N/rad",   "N m/rad",
                                        "m/s^2", "kg m^2/s", "rad/s", "rad/s^2", "rad/(N m)",
                                        "N s/m", "kg/m^3",   "J/m",   "N m^2/m", "1/(N m)",
                                        "m^6",   "N/m^2",    "1/s",   "m/N"},
                             *const none[] = {"N m/",  "/m",   "m^",   "m^1", "N/m/m", "1/(N m",
                                              "N  m",  "m)",   "J s ", "j",   "1/()",  "m^22",
                                              "N/m m", "kN s", "mN/m", "(m)"};
    mistakes m;
    for (size_t i = 0; i < sizeof taken / sizeof taken[0]; i++)
        gsl_test(message_of(taken[i], &m)[0] != '\0', "%s: %s", taken[i], message_of(taken[i], &m));
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++)
        gsl_test(message_of(none[i], &m)[0] == '\0', "'%s' is refused", none[i]);
}

static void units_tests(void)
{
    mistakes m;
    check_si();
    for (size_t i = 0; i < sizeof foreign / sizeof foreign[0]; i++)
        remedy_of(foreign[i].unit, foreign[i].si, foreign[i].factor);
    gsl_test(strstr(message_of("Nm", &m), "write unit: N m") == NULL, "Nm");
    gsl_test(strstr(message_of("-", &m), "write unit: 1") == NULL, "a dash");
    gsl_test(strstr(message_of("", &m), "write unit: 1") == NULL, "nothing");
    gsl_test(strstr(message_of("furlong", &m), "is unknown") == NULL, "a furlong");
    gsl_test_int(m.list[0].line, 3, "its line");
    gsl_test_int(m.list[0].column, 10, "its column");
}

int main(void)
{
    expression_tests();
    document_tests();
    units_tests();
    return gsl_test_summary();
}
