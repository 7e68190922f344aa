/* Numbers show what is known of them: values to the second digit of their uncertainty, errors in
 * percent. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/study/study.h"

static void says(const char *text, const char *expected, const char *what)
{
    gsl_test(strcmp(text, expected) != 0, "%s: '%s', should be '%s'", what, text, expected);
}

static void known(double value, double uncertainty, const char *expected)
{
    char text[ROUNDING_TEXT];
    rounding_known(value, uncertainty, text);
    says(text, expected, "a value and its uncertainty");
}

static void percent(double error, const char *expected)
{
    char text[ROUNDING_TEXT];
    rounding_percent(error, text);
    says(text, expected, "an error");
    gsl_test(strlen(text) > 11, "'%s' is no wider than its column", text);
}

/* Of any number: what is shown is the value as far as it is known, and no more is shown. */
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

int main(void)
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
    return gsl_test_summary();
}
