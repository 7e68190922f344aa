/* Functions of time in pieces: where one ends the next begins, which of them hang together, and
 * which are finite. */
#include "cases/scene/scene.h"

#include <gsl/gsl_test.h>
#include <math.h>
#include <string.h>

static scene_function pieces(int count, const double until[], const char *const text[])
{
    scene_function f = {0, NULL, 0};
    for (int i = 0; i < count; i++)
        gsl_test_int(function_add(&f, until[i], text[i]), 0, "piece %d", i);
    return f;
}

static void check_ends(void)
{
    const double until[] = {1, 3, 0};
    const char *const text[] = {"t", "2*t", "5"};
    static const double instant[] = {0, 0.5, 1, 2, 3, 100}, value[] = {0, 0.5, 2, 4, 5, 5},
                        rate[] = {1, 1, 2, 2, 0, 0};
    scene_function f = pieces(3, until, text), copy = {0, NULL, 0};
    fault why;
    double at[3];
    gsl_test_int((int)function_check(&f, &why), STATUS_OK, "three pieces");
    for (int i = 0; i < 6; i++) {
        function_at(&f, instant[i], at);
        gsl_test_abs(at[0], value[i], 0, "value at %g", instant[i]);
        gsl_test_abs(at[1], rate[i], 0, "rate at %g: of the piece behind", instant[i]);
    }
    function_at(&f, nextafter(1, 0), at);
    gsl_test_abs(at[0], 1, 1e-15, "just before the end of a piece");
    f.scale = 3;
    gsl_test_int(function_copy(&copy, &f), 0, "copied");
    function_free(&f);
    function_at(&copy, 2, at);
    gsl_test_abs(at[0], 12, 0, "a copy has the scale");
    gsl_test_abs(at[1], 6, 0, "of the rate too");
    function_free(&copy);
}

static void check_order(void)
{
    const double falls[] = {2, 1, 0}, last[] = {2, 0};
    const char *const text[] = {"1", "2", "3"};
    fault why;
    scene_function f = pieces(3, falls, text);
    gsl_test_int((int)function_check(&f, &why), STATUS_REFUSED, "pieces out of order");
    gsl_test(strstr(why.text, "piece 2") == NULL, "names the piece: %s", why.text);
    function_free(&f);
    f = pieces(2, last, text);
    gsl_test_int((int)function_check(&f, &why), STATUS_OK, "the last piece has no end");
    function_free(&f);
}

/* Two pieces that meet at 1 s; derivative -1: smooth. */
static void check_joint(const char *before, const char *behind, double end, int derivative)
{
    const double until[] = {1, 0};
    const char *const text[] = {before, behind};
    scene_function f = pieces(2, until, text);
    double time = NAN;
    int which = -1;
    const int smooth = function_smooth(&f, end, &time, &which);
    gsl_test_int(smooth, derivative < 0, "%s, then %s, to %g s", before, behind, end);
    if (!smooth) {
        gsl_test_int(which, derivative, "%s, then %s: what jumps", before, behind);
        gsl_test_abs(time, 1, 0, "where");
    }
    function_free(&f);
}

static void check_joints(void)
{
    check_joint("t^2", "2*t - 1", 2, -1);
    check_joint("t^2", "2*t - 1.1", 2, 0);
    check_joint("t^2", "t", 2, 1);
    check_joint("t^2", "t", 1, -1); /* nothing comes behind the joint */
    check_joint("t^2", "7", 0.5, -1);
}

/* where: NAN: finite */
static void check_finite(const char *before, const char *behind, int derivatives, double end,
                         double where)
{
    const double until[] = {1, 0};
    const char *const text[] = {before, behind};
    scene_function f = pieces(2, until, text);
    double time = NAN;
    const int finite = function_finite(&f, end, derivatives, &time);
    gsl_test_int(finite, isnan(where), "%s, then %s: finite to %g s", before, behind, end);
    if (!finite)
        gsl_test_abs(time, where, 1e-12, "%s, then %s: where not", before, behind);
    function_free(&f);
}

static void check_poles(void)
{
    check_finite("t", "1", 2, 4, NAN);
    check_finite("sqrt(t)", "1", 0, 4, NAN);
    check_finite("sqrt(t)", "1", 1, 4, 0);
    check_finite("t^1.5", "1", 2, 4, 0);
    check_finite("1/(t - 1)", "0", 0, 4, 1); /* at the end of the piece, where steps end */
    check_finite("1", "1/(t - 2.5)", 0, 4, 2.5);
    check_finite("1", "1/(t - 2.5)", 0, 2, NAN);
    check_finite("1", "log(2 - t)", 0, 4, 1 + 22 * 3. / 64);
    check_finite("exp(1e4*t)", "1", 0, 0.5, 5. / 64);
}

int main(void)
{
    check_ends();
    check_order();
    check_joints();
    check_poles();
    return gsl_test_summary();
}
