/* What an analysis hands over of eigenvalues: all of it, and why there are no more; what one kind
 * leaves cannot be read from another. */
#include <gsl/gsl_test.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "elements/test/ended.h"
#include "harness/newton/newton.h"

static void handed_over(status outcome, int rounding, const char *reason, const char *said)
{
    double *mu = malloc(sizeof *mu), *mode = malloc(sizeof *mode), *error = malloc(sizeof *error);
    eigen_side from = {.count = 1,
                       .mu = mu,
                       .mode = mode,
                       .error = error,
                       .status = outcome,
                       .rounding = rounding};
    analysis_outcome o = {.kind = SCENE_BUCKLING};
    outcome_side *side = &o.left.spectrum.positive;
    snprintf(from.reason, sizeof from.reason, "%s", reason);
    outcome_take(&from, side);
    gsl_test(side->count != 1 || side->value != mu || side->mode != mode || side->error != error ||
                 side->status != outcome,
             "'%s': what was found", reason);
    gsl_test(from.mu != NULL || from.mode != NULL || from.error != NULL,
             "'%s': it is not freed twice", reason);
    gsl_test(said == NULL ? side->reason[0] != '\0' : strstr(side->reason, said) == NULL,
             "'%s', %d lost: says '%s'", reason, rounding, side->reason);
    outcome_free(&o);
}

static void read_displacements(const void *o)
{
    outcome_displacements(o);
}
static void read_spectrum(const void *o)
{
    outcome_spectrum_of(o);
}
static void read_path(const void *o)
{
    outcome_path_of(o);
}
static void read_compliance(const void *o)
{
    outcome_compliance_of(o);
}
static void read_rotation(const void *o)
{
    outcome_rotation_of(o);
}
static void read_continuation(const void *o)
{
    outcome_continuation_of(o);
}
static void read_walk(const void *o)
{
    analysis_outcome copy = *(const analysis_outcome *)o;
    outcome_walk(&copy);
}

static void by_kind(void)
{
    enum { KINDS = SCENE_ROTATION + 1 };
    static const struct {
        const char *name;
        void (*read)(const void *);
        unsigned kinds; /* that leave it */
    } row[] = {
        {"displacements", read_displacements, 1 << SCENE_LINEAR},
        {"spectrum", read_spectrum, 1 << SCENE_BUCKLING | 1 << SCENE_MODAL},
        {"path", read_path,
         1 << SCENE_STATIC | 1 << SCENE_COMPLIANCE | 1 << SCENE_CONTINUATION | 1 << SCENE_ROTATION},
        {"compliance", read_compliance, 1 << SCENE_COMPLIANCE},
        {"rotation", read_rotation, 1 << SCENE_ROTATION},
        {"continuation", read_continuation, 1 << SCENE_CONTINUATION},
        {"walk", read_walk, 1 << SCENE_STATIC | 1 << SCENE_ROTATION},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++)
        for (int kind = 0; kind < KINDS; kind++)
            gsl_test_int(
                ended_by(row[i].read, &(analysis_outcome){.kind = (scene_analysis_kind)kind}),
                row[i].kinds >> kind & 1 ? 0 : SIGABRT, "%s of kind %d", row[i].name, kind);
}

int main(void)
{
    by_kind();
    handed_over(STATUS_OK, 0, "", NULL);
    handed_over(STATUS_OK, 1, "", "round-off");
    handed_over(STATUS_OK, 3, "", "round-off");
    handed_over(STATUS_NOT_CONVERGED, 0, "2 are missing", "2 are missing");
    handed_over(STATUS_NOT_CONVERGED, 1, "2 are missing", "2 are missing");
    return gsl_test_summary();
}
