/* Common parts of built-in cases. */
#ifndef BEAMWORK_CASES_SHARED_SHARED_H
#define BEAMWORK_CASES_SHARED_SHARED_H

#include "cases/case.h"
#include "cases/scene/scene.h"

/* The spherical flexure joint of N section 4.2: base - three folded sheets - intermediate body -
 * three more folded sheets - end effector. All fold lines pass through the centre of the joint. The
 * geometry is reconstructed from N Table 1 and the published stiffnesses. */

/* The first parameters of every case with such joints, in this order. */
enum {
    JOINT_LENGTH,
    JOINT_WIDTH,
    JOINT_THICKNESS,
    JOINT_YOUNG,
    JOINT_POISSON,
    JOINT_FOLD_ANGLE,
    JOINT_RADIUS,
    JOINT_POLAR,
    JOINT_AZIMUTH,
    JOINT_FOLD_WARPING,
    JOINT_WAGNER,
    JOINT_DIRECTION,
    JOINT_PARAMETERS
};

/* Table of these parameters. */
extern const parameter_type joint_parameters[];

#define JOINT_DEGREE 0.017453292519943295

/* Sets the section and the physics that all joints of a scene share; Rejects sheets that would
 * extend through the centre. Sets *profile to the index of the section. */
status joint_prepare(const double value[], scene *s, int *profile, fault *f);

/* Adds one joint between two bodies (nodes of the scene). centre: [m]; axes: columns are x (azimuth
 * 0), y and z of the joint in global axes, row-major. Returns the node of the intermediate body,
 * which is at the centre. */
int joint_add(const double value[], scene *s, int profile, const double centre[3],
              const double axes[9], int base, int effector);

/* The flexure hexapod of N section 4.3: a platform carried by six legs, each of a crank, a rod and
 * two spherical joints. The paper does not state the dimensions, which are therefore synthetic. */

enum { HEXAPOD_LEGS = 6 };

/* Parameters of every case with such a hexapod, after those of its joints. */
enum {
    HEXAPOD_BASE_RADIUS = JOINT_PARAMETERS,
    HEXAPOD_CRANK_LENGTH,
    HEXAPOD_CRANK_AZIMUTH,
    HEXAPOD_PLATFORM_RADIUS,
    HEXAPOD_PLATFORM_AZIMUTH,
    HEXAPOD_HEIGHT,
    HEXAPOD_PARAMETERS
};
extern const parameter_type hexapod_parameters[];

/* Nodes of the free bodies of a leg: the rod, at its lower end, and the intermediate bodies of the
 * joints, at their centres, the lower joint first. */
typedef struct hexapod_leg {
    int rod, joint[2];
} hexapod_leg;

/* Adds the node of the platform at the centre of its joints. The node remains free. */
int hexapod_platform(const double value[], scene *s);
/* Adds all legs, with the cranks rotated by the driver `angle` [rad] about horizontal tangents of
 * the base circle, positive upwards. Rejects cranks that extend beyond the centre. */
status hexapod_add(const double value[], scene *s, int angle, int platform, int *profile,
                   hexapod_leg legs[HEXAPOD_LEGS], fault *f);

/* The clamped sheet flexure shared by several scenes (N section 4.1): along x, with its width along
 * z and its thickness along y. */

/* The first parameters of every such case, in this order. */
enum {
    SHEET_LENGTH,
    SHEET_WIDTH,
    SHEET_THICKNESS,
    SHEET_YOUNG,
    SHEET_POISSON,
    SHEET_DEFLECTION,
    SHEET_TIP_WARPING,
    SHEET_WARPING,
    SHEET_SHEAR,
    SHEET_TRAPEZE,
    SHEET_WAGNER,
    SHEET_SHEAR_FACTOR,
    SHEET_MOMENTS,
    SHEET_PARAMETERS
};

/* Table of these parameters. */
extern const parameter_type sheet_parameters[];

/* Sets a steel-like sheet section with its width along the member's local z. shear_factor 0:
 * computed from Poisson's ratio. */
void sheet_section(double width, double thickness, double young, double poisson,
                   double shear_factor, section_spec *out);

/* Adds the section, nodes, a member with a clamped root, physics and meshes. The tip remains free.
 * Sets *root and *tip. Rejects a tip deflection that is too large for the length. */
status sheet_build(const double value[], scene *s, int *root, int *tip, fault *f);

/* Adds the compliance of the tip at the end of a static path, with the prescribed motion replaced
 * by its reactions. The quantities are the entries C_<response>_<load> whose rows and columns are
 * listed. */
void sheet_add_compliance(scene *s, int analysis, const int (*entries)[2], int count);

/* Closed-form solution of a clamped-free sheet flexure (N section 3.5, Eq. 54), derived by hand
 * for the state of sheet_cantilever: tip displaced along y and not rotated. It uses one
 * Hellinger-Reissner interpolation for the whole sheet and is therefore a prediction with a model
 * error. */

extern const char sheet_prediction_source[];

typedef struct sheet_prediction {
    double u_x;        /* displacement of the tip along x [m] */
    double F_y, M_z;   /* reactions [N, N m] */
    double C_xx, C_zz; /* compliance of the tip for spatial moments [m/N] */
} sheet_prediction;

/* Computes the solution. tip_warps: 1 if the tip is free to warp; shear: 0 if rigid in shear; k:
 * shear factor. Values that do not exist are NAN. */
sheet_prediction sheet_prediction_of(const section *c, double length, double deflection,
                                     int tip_warps, int shear, scene_moments moments);

/* Common parts of the cases with transient analyses. */

/* The first parameters of every such case, in this order. */
enum { TIMED_TIME, TIMED_INTEGRATOR, TIMED_STEP, TIMED_TOLERANCE, TIMED_PARAMETERS };
#define TIMED_INTEGRATORS "alpha|conserving|radau|explicit"
/* Entries with the defaults for the evaluation of meshes: error-controlled steps whose time error
 * is far below the error of the meshes. Each case specifies its tolerance. */
#define TIMED_HOW(step, rule, tolerance)                                                           \
    [TIMED_INTEGRATOR] = {"integrator",                                                            \
                          "",                                                                      \
                          SCENE_RADAU,                                                             \
                          0,                                                                       \
                          0,                                                                       \
                          TIMED_INTEGRATORS,                                                       \
                          "integration method of the motion"},                                     \
    [TIMED_STEP] = {"step", "s", step, 1e-9, 1e3, NULL, "time step of the integration: " rule},    \
    [TIMED_TOLERANCE] = {                                                                          \
        "tolerance",                                                                               \
        "1",                                                                                       \
        tolerance,                                                                                 \
        0,                                                                                         \
        0.1,                                                                                       \
        NULL,                                                                                      \
        "tolerance of the time error, relative to the largest motion; 0: all steps are equal"}

/* Adds a motion that ends at the time of observation. follows: SCENE_NONE or a static path; start:
 * initial velocities. */
int timed_add(scene *s, const double value[], int follows, scene_start start);
/* Adds the coordinates x, y and z of a node that have a name (not NULL). size: reference length [m]
 * for errors of coordinates that are smaller. */
void timed_places(scene *s, int motion, int node, double size, const char *const name[3]);

/* Adds a driver that moves from 0 to `end` [m or rad] within this time [s] and is then constant. It
 * is 10 s^3 - 15 s^4 + 6 s^5, which starts and ends with zero acceleration. */
int timed_driver(scene *s, double end, double duration);

#endif
