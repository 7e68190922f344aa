#include "cases/format/functions.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "elements/math/pi.h"

static double sign_of(double x)
{
    return (x > 0) - (x < 0);
}

/* The remainder with the sign of the divisor, as of an angle in turns. */
static double modulo(double x, double y)
{
    const double rest = fmod(x, y);
    return rest != 0 && (rest < 0) != (y < 0) ? rest + y : rest;
}

static const function all[] = {
    {.name = "pi", .value = PI},
    {.name = "deg", .value = PI / 180},
    {.name = "abs", .arguments = 1, .of_one = fabs},
    {.name = "sign", .arguments = 1, .of_one = sign_of},
    {.name = "sqrt", .arguments = 1, .of_one = sqrt},
    {.name = "exp", .arguments = 1, .of_one = exp},
    {.name = "log", .arguments = 1, .of_one = log},
    {.name = "sin", .arguments = 1, .of_one = sin},
    {.name = "cos", .arguments = 1, .of_one = cos},
    {.name = "tan", .arguments = 1, .of_one = tan},
    {.name = "asin", .arguments = 1, .of_one = asin},
    {.name = "acos", .arguments = 1, .of_one = acos},
    {.name = "atan", .arguments = 1, .of_one = atan},
    {.name = "floor", .arguments = 1, .of_one = floor},
    {.name = "ceil", .arguments = 1, .of_one = ceil},
    {.name = "atan2", .arguments = 2, .of_two = atan2},
    {.name = "hypot", .arguments = 2, .of_two = hypot},
    {.name = "mod", .arguments = 2, .of_two = modulo},
    {.name = "min", .arguments = -1, .of_two = fmin},
    {.name = "max", .arguments = -1, .of_two = fmax},
};
enum { FUNCTIONS = sizeof all / sizeof all[0] };

const function *functions_find(const char *name, int length)
{
    for (int i = 0; i < FUNCTIONS; i++)
        if (strlen(all[i].name) == (size_t)length && memcmp(all[i].name, name, (size_t)length) == 0)
            return &all[i];
    return NULL;
}

const char *functions_name(int i)
{
    return i < FUNCTIONS ? all[i].name : NULL;
}
