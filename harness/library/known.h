/* The packed truths, of which HDF5 lets one thread read at a time. */
#ifndef BEAMWORK_KNOWN_H
#define BEAMWORK_KNOWN_H

#include "harness/study/study.h"

/* Their place from now on; NULL: where they usually are. Reads them to see. */
status known_place(const char *path, fault *f);
/* Those of a case with the ledger; type NULL: the ledger alone. */
status known_read(const case_type *type, truths *out, fault *f);
/* Those of all cases. */
status known_read_all(truths *out, fault *f);

/* The lock of HDF5 alone: of two threads that want the same truths one reads, and a process is
 * forked while none does. */
void known_hold(void);
void known_let_go(void);
/* known_read of who holds it. */
status known_read_held(const case_type *type, truths *out, fault *f);
/* Around all else that calls HDF5; what the host wants told of its errors is given back. */
void known_lock(void);
void known_unlock(void);

#endif
