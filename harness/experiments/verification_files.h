/* The files that a verification leaves: HDF5, JSON, JUnit, Markdown, and the findings that it would
 * need. What they say of a case is put together as soon as the case is judged. */
#ifndef BEAMWORK_VERIFICATION_FILES_H
#define BEAMWORK_VERIFICATION_FILES_H

#include "harness/records/records.h"
#include "harness/study/study.h"

typedef struct verification_files {
    const char *output, *json, *junit, *markdown, *propose; /* NULL: none */
    const sweep *sweep;
    const judgement *judged;
    store store;    /* open where there is an output */
    json_part part; /* likewise of JSON */
    int open;
} verification_files;

/* The paths are given; sweep and judgement live until the files are closed. */
status verification_files_open(verification_files *, const sweep *, const judgement *, fault *f);
/* A case, all of whose series have been judged: of verification.h, with the files as context. */
void verification_files_case(void *files, const case_type *);
/* Writes all, with what it was computed on; of an interrupted run under names that say so. */
status verification_files_close(verification_files *, const overview *, const environment *e,
                                fault *f);
/* Without writing; nothing where they are closed. */
void verification_files_drop(verification_files *);

#endif
