/* Parts and their instances: sub-assemblies described once in axes of their own, and placed in the
 * scene. */
#ifndef BEAMWORK_PLACEMENT_H
#define BEAMWORK_PLACEMENT_H

#include "cases/format/unroll.h"

/* Where an instance stands. */
typedef struct placement {
    const char *name;             /* of the instance: its entries are NAME.ENTRY */
    double origin[3];             /* [m] */
    int turned;                   /* 0: its axes are those of the scene */
    double R[9];                  /* columns: its axes in the scene, row-major */
    const document_node *connect; /* PORT: NODE; NULL: none */
} placement;

enum { PLACEMENT_LISTS = 4 };
/* Of a part: "nodes", "members", "springs", "loads". */
extern const char *const placement_list[PLACEMENT_LISTS];

/* Adds the entries of all instances of the scene behind list[k] of count[k], in the order of
 * placement_list. */
void placement_unroll(const document_node *root, const scope *names, arena *a, mistakes *m,
                      unrolled *list[], int count[]);

/* v <- R v; p <- origin + R p. NULL: nothing changes. */
void placement_turn(const placement *, double v[3]);
void placement_move(const placement *, double p[3]);
/* The scene's node that a port of the instance is connected to, or NULL: it is no port. */
const document_node *placement_port(const placement *, const char *name);

#endif
