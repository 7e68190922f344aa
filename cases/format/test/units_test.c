/* Units of scene files: those of the SI are taken; of others the remedy says the right factor, and
 * a unit that is taken. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cases/format/format_impl.h"
#include "elements/math/pi.h"

/* What the check says; empty: nothing. */
static const char *said(const char *unit, mistakes *m)
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

/* "write 20 mm as 20e-3 and unit: m": 20 mm are 20 times the factor of m. */
static void remedy_of(const char *unit, const char *si, double factor)
{
    mistakes m;
    const char *text = strstr(said(unit, &m), "write ");
    char written[40] = "", taken[40] = "";
    double amount = NAN, value = NAN;
    gsl_test(text == NULL, "%s has a remedy", unit);
    const char *as = text != NULL ? strstr(text, " as ") : NULL,
               *unit_at = text != NULL ? strstr(text, " and unit: ") : NULL;
    gsl_test(as == NULL || unit_at == NULL, "%s: a value and its unit", unit);
    if (as == NULL || unit_at == NULL)
        return;
    sscanf(text, "write %lf", &amount);
    snprintf(written, sizeof written, "%.*s", (int)(unit_at - as - 4), as + 4);
    snprintf(taken, sizeof taken, "%s", unit_at + strlen(" and unit: "));
    mistakes none = {.file = "test"};
    const document_node node = {
        .kind = DOCUMENT_TEXT, .line = 1, .column = 1, .inset = 0, .text = written};
    gsl_test(!expression_number(&node, NULL, &none, &value), "%s: '%s' is a number", unit, written);
    gsl_test(!(fabs(value / (amount * factor) - 1) < 1e-12), "%s: %g of it are %.17g %s", unit,
             amount, value, si);
    gsl_test(strcmp(taken, si) != 0, "%s: in %s", unit, taken);
    gsl_test(said(si, &m)[0] != '\0', "%s is taken: %s", si, said(si, &m));
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
        gsl_test(said(taken[i], &m)[0] != '\0', "%s: %s", taken[i], said(taken[i], &m));
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++)
        gsl_test(said(none[i], &m)[0] == '\0', "'%s' is refused", none[i]);
}

int main(void)
{
    mistakes m;
    check_si();
    for (size_t i = 0; i < sizeof foreign / sizeof foreign[0]; i++)
        remedy_of(foreign[i].unit, foreign[i].si, foreign[i].factor);
    gsl_test(strstr(said("Nm", &m), "write unit: N m") == NULL, "Nm");
    gsl_test(strstr(said("-", &m), "write unit: 1") == NULL, "a dash");
    gsl_test(strstr(said("", &m), "write unit: 1") == NULL, "nothing");
    gsl_test(strstr(said("furlong", &m), "is unknown") == NULL, "a furlong");
    gsl_test_int(m.list[0].line, 3, "its line");
    gsl_test_int(m.list[0].column, 10, "its column");
    return gsl_test_summary();
}
