#ifndef BEAMWORK_CASES_SHARED_SHARED_H
#define BEAMWORK_CASES_SHARED_SHARED_H

#include "cases/case.h"
#include "cases/scene/scene.h"

/* The spherical flexure joint of N section 4.2. The joint consists of a base, three folded sheets,
 * an intermediate body, three more folded sheets, and an end effector. All fold lines pass through
 * the centre of the joint. Its geometry is derived from N Table 1 and the published stiffnesses. */

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

/* Sets the section and the omitted physics, for all joints of a scene. Sets *profile to the index
 * of the section. REFUSED: the sheets would extend through the centre. */
status joint_prepare(const double value[], scene *s, int *profile, fault *f);

/* Adds one joint between two bodies (nodes of the scene). `centre` is in [m]. The columns of
 * `axes`, which is row-major, are x (azimuth 0), y and z of the joint in global axes. Returns the
 * node of the intermediate body, which is at the centre. */
int joint_add(const double value[], scene *s, int profile, const double centre[3],
              const double axes[9], int base, int effector);

/* The flexure hexapod of N section 4.3: a platform on six legs, each of which has a crank, a rod
 * and two spherical joints. The paper does not state the dimensions, which are therefore
 * synthetic. */

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
/* Adds all legs. The driver `angle` [rad] rotates the cranks about horizontal tangents of the base
 * circle, positive upwards. REFUSED: the cranks extend beyond the centre. */
status hexapod_add(const double value[], scene *s, int angle, int platform, int *profile,
                   hexapod_leg legs[HEXAPOD_LEGS], fault *f);

/* The clamped sheet flexure of N section 4.1, along x, with its width along z and its thickness
 * along y. */

/* The first parameters of every case with this sheet, in this order. */
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

/* Sets the rectangular section of a sheet, with its width along the local z axis of the member, and
 * with Iw and the Wagner constant of a thin sheet. If shear_factor is 0, the shear factor is
 * computed from Poisson's ratio. */
void sheet_section(double width, double thickness, double young, double poisson,
                   double shear_factor, section_spec *out);

/* Adds the section, the nodes, a member with a clamped root, the physics and the meshes. The tip
 * remains free. Sets *root and *tip. REFUSED: the tip deflection is too large for the length. */
status sheet_build(const double value[], scene *s, int *root, int *tip, fault *f);

/* Adds quantities C_<response>_<load> of a compliance analysis: the entries whose rows and columns
 * are listed. */
void sheet_add_compliance(scene *s, int analysis, const int (*entries)[2], int count);

/* Closed-form solution of a clamped-free sheet flexure (N section 3.5, Eq. 54). In the state of
 * sheet_cantilever, the tip is displaced along y and not rotated. One Hellinger-Reissner
 * interpolation represents the whole sheet, so the solution is approximate. */

extern const char sheet_prediction_source[];

typedef struct sheet_prediction {
    double u_x;        /* displacement of the tip along x [m] */
    double F_y, M_z;   /* reactions [N, N m] */
    double C_xx, C_zz; /* compliance of the tip along x and along z [m/N] */
} sheet_prediction;

/* Computes the solution. tip_warps is 1 if the tip is free to warp. `shear` is 0 if the sheet is
 * rigid in shear. `moments` is the convention of the tip moments in C_zz. Values that do not exist
 * are NAN. */
sheet_prediction sheet_prediction_of(const section *c, double length, double deflection,
                                     int tip_warps, int shear, scene_moments moments);

/* The first parameters of every case with a transient analysis, in this order. */
enum { TIMED_TIME, TIMED_INTEGRATOR, TIMED_STEP, TIMED_TOLERANCE, TIMED_PARAMETERS };
#define TIMED_INTEGRATORS "alpha|conserving|radau|explicit"
/* Rows of these parameters. The defaults are error-controlled steps whose error is far below that
 * of the meshes. Each case specifies its tolerance. */
#define TIMED_HOW(step, rule, tolerance)                                                           \
    [TIMED_INTEGRATOR] =                                                                           \
        {"integrator", "", SCENE_RADAU, 0, 0, TIMED_INTEGRATORS, "time-integration method"},       \
    [TIMED_STEP] = {"step", "s", step, 1e-9, 1e3, NULL, "time step of the integration: " rule},    \
    [TIMED_TOLERANCE] = {"tolerance",                                                              \
                         "1",                                                                      \
                         tolerance,                                                                \
                         0,                                                                        \
                         0.1,                                                                      \
                         NULL,                                                                     \
                         "tolerance of the time-integration error, relative to the largest "       \
                         "displacement; 0: all steps are equal"}

/* Adds a motion that ends at the time of observation. `follows` is SCENE_NONE or a static path, and
 * `start` contains the initial velocities. */
int timed_add(scene *s, const double value[], int follows, scene_start start);
/* Adds the displacements of a node along x, y and z whose names are not NULL. Errors are relative
 * to at least `size` [m]. */
void timed_places(scene *s, int motion, int node, double size, const char *const name[3]);

/* Adds a driver that moves from 0 to `end` [m or rad] within this time [s] and is then constant.
 * With s = t/duration, the value is `end` times 10 s^3 - 15 s^4 + 6 s^5, which starts and ends with
 * zero acceleration. */
int timed_driver(scene *s, double end, double duration);

#endif
