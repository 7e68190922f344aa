/* Cross-section constants: what a beam element needs to know of a section.
 *
 * Axes: x along the line of centroids, y and z principal.  A section is given
 * by straight thin walls (open, or with closed cells), as a solid rectangle, as a round tube, by
 * its numbers, or by two matrices. */
#ifndef BEAMWORK_SECTION_SECTION_H
#define BEAMWORK_SECTION_SECTION_H

#include "elements/shared/status.h"

enum { SECTION_MAX_POINTS = 32, SECTION_MAX_WALLS = 32 };

/* Constants about the centroid and principal axes; all SI. */
typedef struct section {
    double young;         /* E [Pa] */
    double shear_modulus; /* G [Pa] */
    double density;       /* rho [kg/m^3] */
    double A;             /* area [m^2] */
    double Iy, Iz;        /* int z^2 dA, int y^2 dA [m^4] */
    double It;            /* Saint-Venant torsion constant [m^4] */
    double Iw;            /* warping constant about the shear centre [m^6]; 0: nothing warps */
    double ys, zs;        /* shear centre relative to the centroid [m] */
    double Ip;            /* polar moment Iy + Iz about the centroid [m^4] */
    double wagner_y;      /* int y (y^2 + z^2) dA [m^5] */
    double wagner_z;      /* int z (y^2 + z^2) dA [m^5] */
    double wagner_torque; /* c of the energy E c kx^4 per length [m^6]: 1/8 int q^2 dA, q what y^2 +
                             z^2 has beyond strains of shortening and bending, w^5 t / 1440 for a
                             sheet (N Eq. 46) */
    double D[9]; /* shear rigidities / G, order y, z, omega [m^2, m^2, m^4; m^3 off the diagonal]:
                    (Qy, Qz, Mw) = G D (gy, gz, gw) */
    double F[9]; /* D^-1, kept because it exists when D would be infinite (F = 0: shear-rigid) */
    double axes_angle;              /* beta [rad]: principal y axis from the wall y axis */
    double centroid[2];             /* in wall coordinates [m] */
    int matrices;                   /* 1: a section by its matrices */
    double stiffness[36], mass[36]; /* of that; else zero */
    double asymmetry; /* of them as they were given, relative to the diagonal: the mean is taken */
    int rectangle;    /* 1: a solid rectangle with the sizes below */
    double width, height; /* of the rectangle: `width` along z (the sheet's w), `height` along y
                             (its t) [m] */
    double expansion;     /* strain of a free fibre by its temperature [1/K] */
} section;

typedef enum section_kind {
    SECTION_WALLS,
    SECTION_RECTANGLE,
    SECTION_TUBE,
    SECTION_CONSTANTS,
    SECTION_MATRICES
} section_kind;

/* Constants of SECTION_CONSTANTS that are zero because a scene specifies so. */
typedef enum section_zero {
    SECTION_ZERO_SHEAR = 1 << 0,    /* D or F */
    SECTION_ZERO_WARPING = 1 << 1,  /* Iw */
    SECTION_ZERO_WAGNER_Y = 1 << 2, /* wagner_y */
    SECTION_ZERO_WAGNER_Z = 1 << 3, /* wagner_z */
    SECTION_ZERO_WAGNER_TORQUE = 1 << 4
} section_zero;

/* Constants that a section may give in place of those that its shape has (a printed table's values,
 * fillets that thin walls do not have). A, Iy, Iz and beta are of walls only. */
#define SECTION_GIVEN(X)                                                                           \
    X(A)                                                                                           \
    X(Iy)                                                                                          \
    X(Iz)                                                                                          \
    X(It) X(Ip) X(Iw) X(ys) X(zs) X(Dy) X(Dz) X(Dw) X(Dyz) X(Dyw) X(Dzw) X(wagner_torque) X(beta)

/* Section of a scene file; section_compute turns it into constants. */
typedef struct section_spec {
    section_kind kind;
    unsigned zeros;                       /* SECTION_ZERO_... */
    double young, shear_modulus, density; /* [Pa, Pa, kg/m^3] */
    int points, walls;
    int cells; /* that the walls close; a wall that closes another one is refused */
    double point[SECTION_MAX_POINTS][2]; /* (y, z) [m] */
    struct {
        int from, to;
        double thickness;
    } wall[SECTION_MAX_WALLS]; /* thickness [m] */
    int thickness_terms; /* 1: add the t^3 terms of formulation notes section 2 (off for thin-walled
                            work) */
    double width, height;   /* rectangle: along z and along y [m] */
    double shear_factor[2]; /* rectangle: k for Qy and Qz; 0: 5/6 from the thickness terms; both 0:
                               their warping shear too */
    int sheet_warping; /* rectangle: Iw = w^3 t^3/144 (same) and It = exact Saint-Venant series in
                          either case */
    double expansion;  /* [1/K] */
    double diameter, wall_thickness; /* tube: outer diameter; half of it: a solid bar [m] */
    section constants; /* SECTION_CONSTANTS: taken as given; D or F must be given. SECTION_MATRICES:
                          stiffness and mass; no material */
    /* In place of what was computed; NAN: keep that. Ip that is not given stays Iy + Iz. */
    struct {
#define SECTION_MEMBER(name) double name;
        SECTION_GIVEN(SECTION_MEMBER)
#undef SECTION_MEMBER
    } given;
} section_spec;

/* Fills every override with NAN and everything else with zero. */
void section_spec_init(section_spec *spec);

/* width along z, height along y [m]. */
section_spec section_spec_rectangle(double young, double shear_modulus, double width,
                                    double height);
/* The constants themselves are zero: the caller fills them. */
section_spec section_spec_constants(double young, double shear_modulus);
/* walls + 1 points (y, z) [m] of an open section; ends[i]: the points of wall i, NULL: one wall
 * after the other. */
section_spec section_spec_walls(double young, double shear_modulus, int walls,
                                const double point[][2], const int ends[][2],
                                const double thickness[]);

/* STATUS_REFUSED with the culprit (wall 2, the sum of ..., D's eigenvalue) for zero or negative
 * sizes, a cell too many, disconnected walls, a point used by no wall, D not positive definite, G
 * or E not positive, nan. */
status section_compute(const section_spec *spec, section *out, fault *f);

/* Sections by their matrices: with the strains of the Simo-Reissner beam along the member's line,
 *   (N, Qy, Qz, Mx, My, Mz) = C (gx, gy, gz, kx, ky, kz),
 * and with the velocity of the line and the angular velocity in the section's axes v = (vx, vy, vz,
 * wx, wy, wz) the kinetic energy 1/2 v . M v per length (Hodges, Nonlinear Composite Beam Theory,
 * 2006, chapters 4 and 5).  Row-major.
 *
 * What else a section has follows for the orders of size and for formulations that know constants
 * only: with E = G = 1 Pa, A = C_11, Iy = C_55, Iz = C_66, It = C_44, shear rigidities C_22 and
 * C_33; nothing warps, the centroid is on the line. */

/* Largest asymmetry of matrices that were measured or printed, relative to the diagonal. */
#define SECTION_MATRICES_SYMMETRIC 1e-6

/* Fills a zeroed section.  REFUSED: C not symmetric or not positive definite; M not that of a
 * slice: mass m, centre (0, cy, cz), a moment of inertia about the centre that is not negative, M =
 * [m 1, -m c~; m c~, J]. What is symmetric, or a slice, within SECTION_MATRICES_SYMMETRIC becomes
 * so. */
status section_matrices(const section_spec *spec, section *out, fault *f);

/* Is there more in the matrices than constants have?  Anything off the diagonal of C; where inertia
 * matters, anything off that of M, and moments of inertia J other than those of a section of one
 * material, where they are requested, or other than Jxx. */
int section_matrices_couple(const section *c, int inertia, int rotary);

/* Centre of mass [m]; (0, 0, 0) without mass. */
void section_matrices_centre(const section *c, double centre[3]);

/* Sections that change along a member: from one description to another of the same form, linearly
 * in its numbers.
 *
 * Every cross-section is that of a prismatic member with the section there, its centroid on the
 * member's line: the shear stresses due to the taper itself are omitted, as usual in beam
 * theory. */

/* May one description change into the other?  REFUSED: another form (rectangle, walls that are
 * connected in another way, D in one and F in the other ...), and, where the section warps, a shear
 * centre that moves, walls that do not stay in their planes, closed cells that are not the same:
 * the sectorial coordinate of a fibre would change along the member, which couples its warping with
 * torsion in a way that no prismatic piece has. ends: what the two come to. */
status section_taper_check(const section_spec *p, const section_spec *q,
                           const section *const ends[2], fault *f);

/* The description at x in [0, 1] from p to q. */
void section_taper_at(const section_spec *p, const section_spec *q, double x, section_spec *out);

#endif
