/* A formulation from outside: a shared object with the symbol beamwork_element, or exec:COMMAND, a
 * process (harness/formulations). */
#ifndef BEAMWORK_PLUGIN_H
#define BEAMWORK_PLUGIN_H

#include "elements/element.h"

/* Loads one; it stays for the life of the program. Refuses what is no shared object, has no such
 * symbol or is no command, was written for another interface (ABI, size) or says too little of
 * itself, with one line that names the file and the remedy. */
status plugin_load(const char *path, const element_type **out, fault *f);

#endif
