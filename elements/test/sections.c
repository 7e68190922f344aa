#include "elements/test/sections.h"

#include <gsl/gsl_test.h>

section sections_computed(const section_spec *spec)
{
    section c = {0};
    fault f = {""};
    gsl_test(section_compute(spec, &c, &f) != STATUS_OK, "a section is accepted: %s", f.text);
    return c;
}

section_spec sections_steel(section_kind kind)
{
    section_spec spec;
    section_spec_init(&spec);
    spec.kind = kind;
    spec.young = 2e11;
    spec.shear_modulus = 8e10;
    return spec;
}

section_spec sections_of(double A, double Iy, double Iz, double It)
{
    section_spec spec = section_spec_constants(1, 1);
    spec.constants = (section){
        .young = 1, .shear_modulus = 1, .A = A, .Iy = Iy, .Iz = Iz, .It = It, .Ip = Iy + Iz};
    return spec;
}
