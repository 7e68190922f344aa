#include "cases/scene/functions.h"

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

static const expression_function all[] = {
    {.name = "pi", .value = PI},
    {.name = "deg", .value = PI / 180},
    {.name = "abs", .arguments = 1, .of_one = fabs, .kinked = 1},
    {.name = "sign", .arguments = 1, .of_one = sign_of, .kinked = 1},
    {.name = "sqrt", .arguments = 1, .of_one = sqrt, .in_time = JET_SQRT},
    {.name = "exp", .arguments = 1, .of_one = exp, .in_time = JET_EXP},
    {.name = "log", .arguments = 1, .of_one = log, .in_time = JET_LOG},
    {.name = "sin", .arguments = 1, .of_one = sin, .in_time = JET_SIN},
    {.name = "cos", .arguments = 1, .of_one = cos, .in_time = JET_COS},
    {.name = "tan", .arguments = 1, .of_one = tan, .in_time = JET_TAN},
    {.name = "asin", .arguments = 1, .of_one = asin, .in_time = JET_ASIN},
    {.name = "acos", .arguments = 1, .of_one = acos, .in_time = JET_ACOS},
    {.name = "atan", .arguments = 1, .of_one = atan, .in_time = JET_ATAN},
    {.name = "sinh", .arguments = 1, .of_one = sinh, .in_time = JET_SINH},
    {.name = "cosh", .arguments = 1, .of_one = cosh, .in_time = JET_COSH},
    {.name = "tanh", .arguments = 1, .of_one = tanh, .in_time = JET_TANH},
    {.name = "floor", .arguments = 1, .of_one = floor, .kinked = 1},
    {.name = "ceil", .arguments = 1, .of_one = ceil, .kinked = 1},
    {.name = "atan2", .arguments = 2, .of_two = atan2},
    {.name = "hypot", .arguments = 2, .of_two = hypot},
    {.name = "mod", .arguments = 2, .of_two = modulo, .kinked = 1},
    {.name = "min", .arguments = -1, .of_two = fmin, .kinked = 1},
    {.name = "max", .arguments = -1, .of_two = fmax, .kinked = 1},
};
enum { FUNCTIONS = sizeof all / sizeof all[0] };

const expression_function *functions_find(const char *name, int length)
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
