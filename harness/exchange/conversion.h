/* Units of other programs: the only place where values are converted.
 *
 * A unit is a product of powers with at most one '/': "N mm", "mm/N", "rad/(N m)", "1/s", "kg/m^3",
 * "%".  Symbols: m mm cm um km in ft, N kN MN mN lbf, Pa kPa MPa GPa, kg g t, s ms us min, Hz kHz,
 * rad mrad deg, rpm, 1. Angles have no dimension. */
#ifndef BEAMWORK_CONVERSION_H
#define BEAMWORK_CONVERSION_H

#include "elements/shared/status.h"

/* factor: 1 `from` = factor `to`.  REFUSED: a unit that is not known, or of another dimension. */
status conversion_factor(const char *from, const char *to, double *factor, fault *f);

#endif
