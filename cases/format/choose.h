/* What hangs on the values of names: whether an entry is there, and which value it is. */
#ifndef BEAMWORK_SCENE_CHOOSE_H
#define BEAMWORK_SCENE_CHOOSE_H

#include "cases/format/scope.h"

/* {NAME: VALUE, NAME: [VALUE, ...], ...}: has each name one of its values? 0 after a mistake. NULL:
 * 1. */
int choose_holds(const document_node *conditions, const scope *names, mistakes *m);
/* {NAME: {VALUE: ..., else: ...}}: what stands behind the value that the name has; anything else is
 * itself. NULL after a mistake. */
const document_node *choose_value(const document_node *n, const scope *names, mistakes *m);

#endif
