#include "harness/language/units.h"

#include <string.h>

static const char *const known[] = {
    "1",   "m",      "rad",     "N",         "N m",   "N/m",   "N m/rad", "N/rad",  "m/N",
    "1/N", "rad/N",  "1/(N m)", "rad/(N m)", "Hz",    "1/s",   "s",       "rad/s",  "m/s",
    "Pa",  "kg",     "kg/m",    "kg/m^3",    "1/m",   "m^2",   "m^3",     "m^4",    "m^5",
    "m^6", "kg m^2", "N m^2",   "N m/m",     "N/m^2", "rad/m", "m/rad",   "N m^2/m"};

static const struct {
    const char *unit, *remedy;
} foreign[] = {{"mm", "write 20 mm as 20e-3 and unit: m"},
               {"cm", "write 20 cm as 0.2 and unit: m"},
               {"km", "write 2 km as 2e3 and unit: m"},
               {"in", "write 2 in as 2*25.4e-3 and unit: m"},
               {"mm^2", "write 2 mm^2 as 2e-6 and unit: m^2"},
               {"mm^4", "write 2 mm^4 as 2e-12 and unit: m^4"},
               {"kN", "write 2 kN as 2e3 and unit: N"},
               {"MN", "write 2 MN as 2e6 and unit: N"},
               {"kNm", "write 2 kNm as 2e3 and unit: N m"},
               {"Nm", "write unit: N m"},
               {"N mm", "write 2 N mm as 2e-3 and unit: N m"},
               {"N/mm", "write 2 N/mm as 2e3 and unit: N/m"},
               {"kN/m", "write 2 kN/m as 2e3 and unit: N/m"},
               {"MPa", "write 210 MPa as 210e6 and unit: Pa"},
               {"N/mm^2", "write 210 N/mm^2 as 210e6 and unit: Pa"},
               {"GPa", "write 210 GPa as 210e9 and unit: Pa"},
               {"deg", "write 45 deg as 45*deg and unit: rad"},
               {"degree", "write 45 degrees as 45*deg and unit: rad"},
               {"g", "write 2 g as 2e-3 and unit: kg"},
               {"t", "write 2 t as 2e3 and unit: kg"},
               {"ms", "write 2 ms as 2e-3 and unit: s"},
               {"kHz", "write 2 kHz as 2e3 and unit: Hz"},
               {"rpm", "write 60 rpm as 60*2*pi/60 and unit: rad/s"},
               {"-", "write unit: 1"},
               {"", "write unit: 1"}};

void units_check(const document_node *unit, mistakes *m)
{
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (strcmp(known[i], unit->text) == 0)
            return;
    for (size_t i = 0; i < sizeof foreign / sizeof foreign[0]; i++)
        if (strcmp(foreign[i].unit, unit->text) == 0) {
            document_mistake(m, unit, 0, "unit '%s': all values are SI; %s", unit->text,
                             foreign[i].remedy);
            return;
        }
    document_mistake(m, unit, 0,
                     "unit '%.40s' is unknown; all values are SI, as m, rad, N, N m, N/m, Pa, "
                     "kg/m^3, Hz, 1",
                     unit->text);
}
