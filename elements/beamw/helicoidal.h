/* Helicoidal strains, those of a beam with uniform strains: the screw displacement that takes node
 * p and its triad to node q, with the rotation vector psi and the translation U along the way, in
 * axes that turn on it, e1 = U_x - l0,  e2 = l0 psi_x,  e3, e4 = l0 psi_y/2 -+ U_z,  e5, e6 = l0
 * psi_z/2 +- U_y,  e7, e8 = l0^2 a. They are J Eq. 7 to first order and the same for p and q
 * exchanged.  Uniform strains of any size are measured exactly, U = l0 (e_x + gamma), psi = l0
 * kappa; J's sines of angles to the chord are not when sections shear. */
#ifndef BEAMWORK_BEAMW_HELICOIDAL_H
#define BEAMWORK_BEAMW_HELICOIDAL_H

#include "elements/beamw/screw_forms.h"

/* e1 .. e6: sign U_translation + part psi_rotation l0. */
static const struct {
    int translation, rotation;
    double sign, part;
} beamw_helicoidal_strain[] = {{0, 0, 1, 0},   {0, 0, 0, 1},   {2, 1, -1, 0.5},
                               {2, 1, 1, 0.5}, {1, 2, 1, 0.5}, {1, 2, -1, 0.5}};
enum { BEAMW_HELICOIDAL_ALONG = 6 };

/* As element_type.strain, of one element or of several in lanes; l0 [m]: its length at rest. */
static inline void beamw_helicoidal_evaluate(double l0, const node_real x[2], strain_real *out)
{
    enum { N = SCREW_COORDINATES };
    screw w;
    beamw_screw_of(l0, x, &w);
    if (out->e != NULL) {
        for (int k = 0; k < BEAMW_HELICOIDAL_ALONG; k++)
            out->e[k] =
                beamw_helicoidal_strain[k].sign * w.U[beamw_helicoidal_strain[k].translation] +
                beamw_helicoidal_strain[k].part * 2 * l0 * w.a[beamw_helicoidal_strain[k].rotation];
        out->e[6] = l0 * l0 * x[0].a;
        out->e[7] = l0 * l0 * x[1].a;
    }
    if (out->J != NULL) {
        screw_gradient g;
        beamw_screw_rates_gradient(&w, &g);
        for (int k = 0; k < BEAMW_HELICOIDAL_ALONG; k++)
            beamw_screw_rates_row(&g, beamw_helicoidal_strain[k].translation,
                                  beamw_helicoidal_strain[k].sign,
                                  beamw_helicoidal_strain[k].rotation,
                                  beamw_helicoidal_strain[k].part * l0, out->J + N * k);
        for (int i = 0; i < 2 * N; i++)
            out->J[6 * N + i] = real_of(0);
        out->J[6 * N + SCREW_AP] = out->J[7 * N + SCREW_AQ] = real_of(l0 * l0);
    }
    if (out->s != NULL && out->H != NULL) {
        const real *s = out->s, f[3] = {s[0], s[4] - s[5], s[3] - s[2]};
        const real t[3] = {l0 * s[1], l0 / 2 * (s[2] + s[3]), l0 / 2 * (s[4] + s[5])};
        beamw_screw_forms_second(&w, f, t, out->H);
    }
}

#endif
