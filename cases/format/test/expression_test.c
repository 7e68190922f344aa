/* Expressions and ranges: values, and the place and remedy of what is none. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

#include "cases/format/format_impl.h"
#include "elements/math/pi.h"

/* The text as a value that begins in line 3, column 10. */
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
        int column; /* from 10 */
        const char *says;
    } all[] = {{"", 10, "ends"},
               {"1+", 12, "ends"},
               {"depth/0*/2", 10, "unknown name 'depth'"},
               {"3/1*/2", 14, "'/' where"},
               {"1/(2-2)", 11, "division by zero"},
               {"lenght*2", 10, "did you mean 'length'"},
               {"20 mm", 13, "SI without units"},
               {"3pi", 11, "* between factors"},
               {"20e-3m", 15, "SI without units"},
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
               {"1 2", 12, "operator missing"},
               {"corner", 10, "choice of words"},
               {"__import__(\"os\")", 10, "unknown name '__import__'"},
               {".", 10, "point without digits"}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        mistakes m = {.file = "f"};
        double value;
        const document_node n = text_node(all[i].text);
        const int read = expression_number(&n, names, &m, &value);
        gsl_test(read || m.count != 1, "'%s' is one mistake", all[i].text);
        gsl_test_int(m.list[0].column, all[i].column, "'%s': its column", all[i].text);
        gsl_test(strstr(m.list[0].text, all[i].says) == NULL, "'%s': %s", all[i].text,
                 m.list[0].text);
    }
}

/* Depth is bounded: neither parentheses nor signs exhaust the stack. */
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
               {"2..2", 1, 2, 2},
               {"0..length/1", 2, 0, 2.385}};
    static const char *const bad[] = {"3..1", "0..1 step 0", "0..1/0",    "0..1/2.5", "0..1e9",
                                      "..2",  "1..",         "0..1 step", "a..b"};
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

int main(void)
{
    arena a = {0};
    const scope *names = scope_number(NULL, "length", 2.385, &a);
    names = scope_word(names, "corner", "free", &a);
    check_values(names);
    check_mistakes(names);
    check_depth();
    check_ranges(names);
    arena_free(&a);
    return gsl_test_summary();
}
