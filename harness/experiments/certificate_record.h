/* Records of certificates. */
#ifndef BEAMWORK_CERTIFICATE_RECORD_H
#define BEAMWORK_CERTIFICATE_RECORD_H

#include "harness/experiments/certificate.h"
#include "harness/experiments/experiment.h"

/* What experiment_element_test finds. */
typedef struct certificates {
    certificate *all;          /* [count] */
    int count, verbose, quiet; /* as certificate_text */
} certificates;

/* Asked by a certificate_request; certificate_free frees what is found. */
extern const experiment_type experiment_element_test;

#endif
