/* Which models have the same answers: formulations that differ in what a scene does not have are
 * the same one there. */
#ifndef BEAMWORK_IDENTITY_H
#define BEAMWORK_IDENTITY_H

#include <stdint.h>

#include "harness/model/model.h"

/* Of whatever was added, in that order. */
typedef struct identity {
    uint64_t part[2];
} identity;

identity identity_begin(void);
void identity_add(identity *, const void *bytes, size_t size);
/* The functions of a model's elements, their data and what was left out: of one scene, two models
 * with the same have the same answers, to the bit. 0: nobody knows, for a formulation may fail from
 * outside. */
int identity_add_model(identity *, const model *);

#endif
