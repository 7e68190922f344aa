/* Cross-section constants for beam elements.
 *
 * The x axis is along the centroidal axis, and y and z are principal axes. A section is given by
 * straight thin walls (open, or with closed cells), by a solid rectangle, by a round tube, by
 * constants, or by two matrices. */
#ifndef BEAMWORK_SECTION_SECTION_H
#define BEAMWORK_SECTION_SECTION_H

#include "elements/shared/status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { SECTION_MAX_POINTS = 32, SECTION_MAX_WALLS = 32 };

/* Constants about the centroid and the principal axes, in SI units. */
typedef struct section {
    double young;         /* Young's modulus E [Pa] */
    double shear_modulus; /* shear modulus G [Pa] */
    double density;       /* rho [kg/m^3] */
    double A;             /* area [m^2] */
    double Iy, Iz;        /* second moments of area int z^2 dA, int y^2 dA [m^4] */
    double It;            /* Saint-Venant torsion constant [m^4] */
    double Iw;            /* warping constant about the shear centre [m^6], or 0 without warping */
    double ys, zs;        /* shear centre relative to the centroid [m] */
    double Ip;            /* polar moment Iy + Iz about the centroid [m^4] */
    double wagner_y;      /* int y (y^2 + z^2) dA [m^5] */
    double wagner_z;      /* int z (y^2 + z^2) dA [m^5] */
    double wagner_torque; /* c [m^6] of the energy E c kx^4 per length. c = 1/8 int q^2 dA, where q
                             is the part of y^2 + z^2 that axial and bending strains cannot
                             represent. c = w^5 t/1440 for a sheet (N Eq. 46) */
    double D[9]; /* shear rigidities divided by G, in the order y, z, omega [m^2, m^2, m^4; m^3 off
                    the diagonal]: (Qy, Qz, Mw) = G D (gy, gz, gw) */
    double F[9]; /* inverse of D in the same order. Rows of shear strains in which the section is
                    rigid are zero in both D and F */
    double axes_angle;  /* angle beta [rad] from the y axis of the walls to the principal y axis */
    double centroid[2]; /* position in the coordinates of the walls [m] */
    int matrices;       /* 1 for a section given by matrices */
    double stiffness[36], mass[36]; /* given matrices; zero for other sections */
    double asymmetry;     /* asymmetry of the given matrices relative to their diagonals; only the
                             symmetric part is used */
    int rectangle;        /* 1 for a solid rectangle with the sizes below */
    double width, height; /* size of the rectangle: `width` w along z, `height` t along y [m] */
    double expansion;     /* strain of a free fibre per temperature change [1/K] */
} section;

typedef enum section_kind {
    SECTION_WALLS,
    SECTION_RECTANGLE,
    SECTION_TUBE,
    SECTION_CONSTANTS,
    SECTION_MATRICES
} section_kind;

/* Constants of SECTION_CONSTANTS that the scene sets to zero. */
typedef enum section_zero {
    SECTION_ZERO_SHEAR = 1 << 0,    /* D or F */
    SECTION_ZERO_WARPING = 1 << 1,  /* Iw */
    SECTION_ZERO_WAGNER_Y = 1 << 2, /* wagner_y */
    SECTION_ZERO_WAGNER_Z = 1 << 3, /* wagner_z */
    SECTION_ZERO_WAGNER_TORQUE = 1 << 4
} section_zero;

/* Constants that a section may specify, which replace those computed from its shape (values of a
 * published table, fillets that thin walls do not have). A, Iy, Iz and beta are accepted only for
 * walls. */
#define SECTION_GIVEN(X)                                                                           \
    X(A)                                                                                           \
    X(Iy)                                                                                          \
    X(Iz)                                                                                          \
    X(It) X(Ip) X(Iw) X(ys) X(zs) X(Dy) X(Dz) X(Dw) X(Dyz) X(Dyw) X(Dzw) X(wagner_torque) X(beta)

/* Section of a scene file, which section_compute converts to constants. */
typedef struct section_spec {
    section_kind kind;
    unsigned zeros;                       /* SECTION_ZERO_... */
    double young, shear_modulus, density; /* [Pa, Pa, kg/m^3] */
    int points, walls;
    int cells; /* number of cells that the walls close; any other number is rejected */
    double point[SECTION_MAX_POINTS][2]; /* (y, z) [m] */
    struct {
        int from, to;
        double thickness;
    } wall[SECTION_MAX_WALLS]; /* thickness [m] */
    int thickness_terms;       /* 1 to add the t^3 terms, 0 for thin-walled theory */
    double width, height;      /* size of a rectangle along z and along y [m] */
    double shear_factor[2];    /* k of a rectangle for Qy and Qz, or 0 for 5/6, from the thickness
                                  terms; if both are 0, the shear due to warping is included */
    int sheet_warping; /* 1 for Iw = w^3 t^3/144 of a rectangle; It is the exact Saint-Venant series
                          in either case */
    double expansion;  /* [1/K] */
    double diameter, wall_thickness; /* outer diameter and wall thickness of a tube [m]; the
                                        thickness of a solid bar is half its diameter */
    section
        constants; /* constants to be used for SECTION_CONSTANTS, with D or F (both zero: rigid in
                      shear), or stiffness and mass for SECTION_MATRICES, without a material */
    /* Values that replace computed values, or NAN where the computed value is used. If Iy or Iz is
     * given without Ip, Ip is Iy + Iz. */
    struct {
#define SECTION_MEMBER(name) double name;
        SECTION_GIVEN(SECTION_MEMBER)
#undef SECTION_MEMBER
    } given;
} section_spec;

/* Sets every override to NAN and all other members to zero. */
void section_spec_init(section_spec *spec);

/* Returns a rectangle with its width along z and its height along y [m]. */
section_spec section_spec_rectangle(double young, double shear_modulus, double width,
                                    double height);
/* Returns a section whose constants are zero and must be set by the caller. */
section_spec section_spec_constants(double young, double shear_modulus);
/* Returns an open section with walls + 1 points (y, z) [m]. ends[i] contains the indices of the two
 * points of wall i. If `ends` is NULL, the walls form a chain. */
section_spec section_spec_walls(double young, double shear_modulus, int walls,
                                const double point[][2], const int ends[][2],
                                const double thickness[]);

/* Computes the constants. Returns STATUS_REFUSED with the cause if a value is not finite, if a
 * dimension, E, G, A, Iy, Iz or Ip is not positive, if rho, It or Iw is negative, if walls are
 * invalid (walls_lines_of) or D or F is not positive definite, if A, Iy, Iz or beta is given for a
 * section without walls, or if section_matrices rejects the matrices. */
status section_compute(const section_spec *spec, section *out, fault *f);

/* Sections given by two row-major matrices. For the strains of the Simo-Reissner beam along the
 * line of the member,
 *   (N, Qy, Qz, Mx, My, Mz) = C (gx, gy, gz, kx, ky, kz).
 * The kinetic energy per length is 1/2 v . M v, where v = (vx, vy, vz, wx, wy, wz) contains the
 * velocity of the line and the angular velocity in section axes (Hodges, Nonlinear Composite Beam
 * Theory, 2006, chapters 4 and 5).
 *
 * Other constants are derived from C and M, for formulations that use only constants.
 * With E = G = 1 Pa, they are A = C_11, Iy = C_55, Iz = C_66 and It = C_44, with shear rigidities
 * C_22 and C_33. There is no warping, and the centroid is on the line. */

/* Largest accepted asymmetry of a matrix, which may have been measured or printed, relative to its
 * diagonal. */
#define SECTION_MATRICES_SYMMETRIC 1e-6

/* Fills a zeroed section. Returns REFUSED if an entry is not finite, if C or M is not symmetric, if
 * C is not positive definite, or if M is not the mass matrix of a slice. Such a matrix is [m 1, -m
 * c~; m c~, J] with the mass m, the centre of mass c = (0, cy, cz) and nonnegative moments of
 * inertia about this centre. Deviations within SECTION_MATRICES_SYMMETRIC are corrected. */
status section_matrices(const section_spec *spec, section *out, fault *f);

/* Returns 1 if the matrices contain more than constants can represent. This is the case for
 * off-diagonal entries of C. If `inertia` is 1, this is also the case for off-diagonal entries of
 * M, for Jxx = 0, and for Jyy and Jzz that differ from those of a section of one material (rotary
 * 1) or from zero (rotary 0). */
int section_matrices_couple(const section *c, int inertia, int rotary);

/* Computes the centre of mass [m], which is (0, 0, 0) if the section has no mass. */
void section_matrices_centre(const section *c, double centre[3]);

/* Tapered members: the dimensions of the section change linearly from one description to another of
 * the same form.
 *
 * Every cross-section is that of a prismatic member with its centroid on the line of the member.
 * Shear stresses due to the taper are neglected, as is usual in beam theory. */

/* Checks that a taper between the two descriptions is possible. `ends` contains the constants of
 * both descriptions. Returns REFUSED if the descriptions have different forms, for example a
 * rectangle and walls, differently connected walls, or D in one description and F in the other.
 * Two different given areas are rejected. Sections with warping are also rejected if the shear
 * centre moves, the principal axes rotate, walls leave their planes, or closed cells differ. The
 * sectorial coordinate of a fibre would then change along the member and couple warping with
 * torsion, which prismatic elements cannot represent. */
status section_taper_check(const section_spec *p, const section_spec *q,
                           const section *const ends[2], fault *f);

/* Interpolates the description at x, from p at x = 0 to q at x = 1. */
void section_taper_at(const section_spec *p, const section_spec *q, double x, section_spec *out);

#ifdef __cplusplus
}
#endif

#endif
