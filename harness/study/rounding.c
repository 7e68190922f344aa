#include "harness/study/rounding.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Decimal exponent of the value when it is rounded to that many digits. */
static int exponent_of(double value, int digits)
{
    char text[ROUNDING_TEXT];
    snprintf(text, sizeof text, "%.*e", digits - 1, value);
    return atoi(strchr(text, 'e') + 1);
}

/* "1.2e-7", with its sign where that is wanted or "-". */
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
    const int widest = digits > 9 ? digits : 9; /* places before the point */
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
