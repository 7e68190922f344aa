/* Several scene files beside, or in the place of, the built-in cases. */
#ifndef BEAMWORK_SCENES_H
#define BEAMWORK_SCENES_H

#include "harness/cli/case_input.h"

typedef struct scenes {
    int count;
    char *path[COMMAND_MAX_CASES]; /* [count] of each file, folders looked into */
    scene_file *file[COMMAND_MAX_CASES];
    const case_type
        *type[2 * COMMAND_MAX_CASES + 1]; /* the built-in ones too where they are wanted */
} scenes;

/* All that --scene names: files, and of a folder every *.yaml in the order of their names; type
 * ends in NULL. Not EXIT_AS_EXPECTED: an exit code, after messages; no two are of one name. */
int scenes_read(const command_request *, scenes *out);
void scenes_free(scenes *);
/* The built-in truths where those cases are wanted, the ledger, the truths of each file, and the
 * tables of one's own project. */
status scenes_truths(const scenes *, const command_request *, truths *t, fault *f);

#endif
