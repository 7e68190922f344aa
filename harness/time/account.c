#include "harness/time/account.h"

#include <math.h>

const double account_gained = 0.01, account_stated = 0.01, account_lost = 0.1;

void account_take(account *a, int steps, const double balance[SCENE_BALANCES])
{
    if (steps > 0)
        a->turned += fabs(balance[SCENE_WORK] - a->work);
    a->work = balance[SCENE_WORK];
    a->largest = fmax(a->largest, balance[SCENE_ENERGY]);
}

double account_size(const account *a)
{
    return fmax(a->largest, a->turned);
}

/* Of all parameters of alpha: force - mass is (1 - rho)/(1 + rho), rho the spectral radius. */
int account_loses(const scene_motion *how)
{
    const double usual = 0.9, most = (1 - usual) / (1 + usual) * (1 + 1e-9);
    return how->tolerance <= 0 ||
           (how->scheme == SCENE_ALPHA && how->alpha.force - how->alpha.mass > most);
}

static const char *remedy(const scene_motion *how)
{
    if (how->tolerance <= 0)
        return "give a smaller step, a tolerance, or the integrator radau or conserving";
    return how->scheme == SCENE_CONSERVING
               ? "give a smaller tolerance, or the integrator radau"
               : "give a smaller tolerance, or the integrator conserving, which keeps energy";
}

double account_most(const account *a, double part, double rounding)
{
    return part * account_size(a) + rounding;
}

status account_judge(const account *a, const scene_motion *how, double time,
                     const double balance[SCENE_BALANCES], double rounding, fault *f)
{
    const double size = account_size(a), drift = balance[SCENE_DRIFT];
    if (!(drift <= account_most(a, account_gained, rounding)))
        return fault_set(f, STATUS_NOT_CONVERGED,
                         "at %g s the motion has %.3g J more energy than work was done, %.2g %% of "
                         "%.3g J, and %g %% is the limit: %s",
                         time, drift, 100 * drift / size, size, 100 * account_gained, remedy(how));
    if (-drift > account_most(a, account_lost, rounding) && !account_loses(how))
        return fault_set(f, STATUS_NOT_CONVERGED,
                         "at %g s the integrator has lost %.3g J of energy, %.2g %% of %.3g J, and "
                         "%g %% is the limit: %s",
                         time, -drift, -100 * drift / size, size, 100 * account_lost, remedy(how));
    return STATUS_OK;
}
