/* Every formulation on every case and parameter point that has a truth: run, and judged as it
 * comes.
 */
#ifndef BEAMWORK_VERIFICATION_H
#define BEAMWORK_VERIFICATION_H

#include "harness/study/study.h"

/* Who takes what is judged while the rest is run. */
typedef struct verification_reader {
    void *context;
    /* A case, once, when all its series have been judged, in the order of the last of them; of an
     * interrupted run only what came before. */
    void (*judged)(void *context, const case_type *);
} verification_reader;

/* Holds the formulations that are named or loaded against the contract of the interface; then runs
 * a planned sweep (study.h) and judges its series in their order, each when all of its point
 * are done; the finest meshes are run again where verdicts may turn on their noise. Formulations
 * that agree become truths of scene files. whole: 1: nothing was selected away, unless the run is
 * interrupted. reader: NULL: none. judgement_free frees *out, also after a failure. */
status verification_run(const sweep_request *, int whole, const verification_reader *reader,
                        truths *, sweep *, judgement *out, fault *);

/* The cells of a planned sweep, or of some of its series, and their noise: not judged. */
status verification_cells(const sweep_request *, truths *, sweep *, fault *);
/* Judges a sweep whose cells have been run for the request. */
status verification_judge(const sweep_request *, int whole, truths *, const sweep *, judgement *out,
                          fault *);

#endif
