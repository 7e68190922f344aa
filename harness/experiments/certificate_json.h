/* Certificates for programs. */
#ifndef BEAMWORK_CERTIFICATE_JSON_H
#define BEAMWORK_CERTIFICATE_JSON_H

#include <stdio.h>

#include "harness/experiments/certificate.h"

status certificate_json(FILE *to, const certificate *all, int count, fault *f);

#endif
