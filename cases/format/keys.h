/* What may stand in a scene file: tables of keys, used to check, to describe and to tell what was
 * meant. */
#ifndef BEAMWORK_SCENE_KEYS_H
#define BEAMWORK_SCENE_KEYS_H

#include "cases/format/document.h"
#include "cases/scene/entry.h"

extern const entry_field keys_let[], keys_refusal[], keys_root[], keys_truth[], keys_parameter[],
    keys_part[], keys_instance[];

/* `for`, `let` and `if`, which every entry may have. */
extern const entry_field keys_loop[];
/* May its entries have them? */
int keys_loops(const entry_field *table);

/* Unknown, missing, misplaced keys and values of the wrong form, in the whole tree. 1: none. */
int keys_check(const document_node *root, mistakes *m);

#endif
