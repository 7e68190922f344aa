/* The keys of scene files as a JSON Schema: editors complete and check with it. */
#ifndef BEAMWORK_SCHEMA_FILE_H
#define BEAMWORK_SCHEMA_FILE_H

#include <stdio.h>

#include "elements/shared/status.h"

status schema_file_write(FILE *to, fault *f);

#endif
