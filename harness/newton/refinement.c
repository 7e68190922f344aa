#include "harness/newton/refinement.h"

#include <math.h>

enum { LEAST = 2, MOST = 30 };

/* Of a correction: beyond the first nobody asks for more; the second is a thousandth of the
 * tolerance that quantities are judged by (SCENE_TOLERANCE), for what is derived from the solution
 * may lose digits of its own.  By the level of refinement.h, eps (L/side)^2 times 2.5, bars beyond
 * L/side = 1300 leave the first, beyond 42000 the second; in a run of verify no correction that was
 * judged by it exceeded 2e-12. */
static const double sure_digits = 1e-9, enough_digits = 1e-6;

refinement_state refinement_judge(solution_refinement *r, double correction)
{
    r->last = correction;
    return correction <= enough_digits ? REFINEMENT_ENDS : REFINEMENT_LOST;
}

refinement_state refinement_next(solution_refinement *r, double correction)
{
    const int step = r->corrections++, settles = !(correction < r->last / 2);
    r->last = correction;
    if (step >= LEAST && correction <= sure_digits)
        return REFINEMENT_ENDS;
    if ((step > LEAST && settles) || step == MOST)
        return refinement_judge(r, correction);
    return REFINEMENT_GOES_ON;
}

status refinement_refuse(const solution_refinement *r, const char *what, fault *f)
{
    const int digits = r->last < 1 ? (int)-log10(r->last) : 0; /* NAN: none */
    return fault_set(f, STATUS_SINGULAR,
                     "%s is lost in round-off: %d of its digits are sure (corrections settle at "
                     "%.1e of it); use fewer elements or a less slender structure",
                     what, digits, r->last);
}

static double size_of(int n, const double weight[], const double x[])
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += weight[i] * x[i] * x[i];
    return sqrt(sum);
}

double refinement_part(int n, const double weight[], const double change[], const double x[],
                       double least)
{
    const double size = size_of(n, weight, change);
    return size == 0 ? 0 : size / fmax(size_of(n, weight, x), least);
}
