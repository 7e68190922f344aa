/* What a result was made with. */
#ifndef BEAMWORK_ENVIRONMENT_H
#define BEAMWORK_ENVIRONMENT_H

typedef struct environment {
    const char *version, *released /* 2026-11-21 */, *commit, *compiler, *flags;
    char libraries[256], processor[128], clock[32]; /* ISO 8601, UTC */
    int threads;
} environment;

environment environment_now(int threads);
const char *environment_version(void); /* of the program, "0.12.0" */

#endif
