/* Constants of sections as names of expressions: SECTION.A. */
#ifndef BEAMWORK_SECTION_NAMES_H
#define BEAMWORK_SECTION_NAMES_H

#include "cases/format/scope.h"
#include "elements/section/section.h"

/* The scope with the constants of one section more; c NULL: it has a mistake, which is told. */
const scope *section_names_add(const scope *names, const char *section_name, const section *c,
                               arena *a);
/* Index of a constant's name among those of every section, or -1. */
int section_names_index(const char *name, size_t length);
/* All of them, for messages. */
extern const char section_names_all[];

#endif
