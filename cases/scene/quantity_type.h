/* A kind of quantity: all that is to be said of it, but for how a solution is asked for it
 * (harness/analysis) where it is more than a reading of nodes.  One file each in cases/quantities:
 * the build finds it. */
#ifndef BEAMWORK_SCENE_QUANTITY_TYPE_H
#define BEAMWORK_SCENE_QUANTITY_TYPE_H

#include <stdio.h>

#include "cases/scene/entry.h"

/* What a kind reads of where nodes are and how they move, in one state of a structure. */
typedef struct quantity_state {
    /* displacement [m] or rotation-vector component [rad]; NAN: it has lost its direction */
    double (*component)(const struct quantity_state *, int node, int component);
    /* the same in the axes of another node */
    double (*relative)(const struct quantity_state *, int from, int node, int component);
    /* place [m], and rotation matrix by rows */
    void (*frame)(const struct quantity_state *, int node, double place[3], double R[9]);
    /* of a motion in time: velocity [m/s], or angular velocity in the node's own axes [rad/s] */
    double (*rate)(const struct quantity_state *, int node, int component);
    double (*driver)(const struct quantity_state *, int driver);
} quantity_state;

/* What is met between the stations of a motion. */
typedef enum quantity_passing {
    QUANTITY_AT_STATIONS,
    QUANTITY_EXTREMES, /* the largest and the least value */
    QUANTITY_CROSSINGS /* these, and when a level is passed */
} quantity_passing;

typedef struct quantity_type {
    const char *key, *summary;
    scene_quantity_kind kind; /* SCENE_READING of one that nothing outside its file names */
    const entry_field *field; /* of the map below the key */
    unsigned analyses;        /* 1 << kind of analysis: those that have it */
    quantity_passing passing;
    /* of the value where nothing else is said; gives its powers of length and force */
    const char *(*unit)(const scene *, const scene_quantity *);
    /* In words; names_analysis: also of which analysis. */
    void (*meaning)(FILE *, const scene *, const scene_quantity *);
    int names_analysis;
    /* NULL of most: is it this one, of two of a kind; what follows from what is read of a file:
     * what is wrong with the key, or NULL; REFUSED: what the table does not say. */
    int (*is)(const scene_quantity *);
    /* As extracted, without factor and offset, of what is read of nodes alone; and the components
     * of turns that it needs, where nodes may turn by themselves: 1: *out is the one of index i, 0:
     * there are no more. */
    double (*read)(const scene_quantity *, const quantity_state *);
    int (*turns)(const scene *, const scene_quantity *, int i, scene_component *out);
    const char *(*settle)(const scene *, scene_quantity *, const char **key);
    status (*check)(const scene *, const scene_quantity *, fault *);
} quantity_type;

/* The type of a quantity; is it this one; makes it one, to be filled. */
const quantity_type *quantity_type_of(const scene_quantity *q);
int quantity_type_is(const quantity_type *, const scene_quantity *q);
void quantity_type_begin(const quantity_type *, scene_quantity *q);

/* Keys of most kinds: first, and last. */
#define QUANTITY_ANALYSIS                                                                          \
    {"analysis",                                                                                   \
     ENTRY_NAME,                                                                                   \
     .needed = 1,                                                                                  \
     .summary = "analysis",                                                                        \
     ENTRY_IN(scene_quantity, analysis),                                                           \
     .of = SCENE_ANALYSES}
#define QUANTITY_TAKEN                                                                             \
    {"at", ENTRY_NUMBER, .group = 1, .summary = "station", .left_out = "as take says"},            \
        {"take",                                                                                   \
         ENTRY_WORD,                                                                               \
         .group = 1,                                                                               \
         .words = SCENE_TAKE_CHOICES,                                                              \
         .summary = "of all stations",                                                             \
         .usual = "last"}
#define QUANTITY_NODE(member)                                                                      \
    {"node",                                                                                       \
     ENTRY_NAME,                                                                                   \
     .needed = 1,                                                                                  \
     .summary = "node",                                                                            \
     ENTRY_IN(scene_quantity, what.of.member),                                                     \
     .of = SCENE_NODES}
#define QUANTITY_COMPONENT(text, member)                                                           \
    {"component",                                                                                  \
     ENTRY_WORD,                                                                                   \
     .needed = 1,                                                                                  \
     .words = ENTRY_COMPONENTS,                                                                    \
     .summary = (text),                                                                            \
     ENTRY_IN(scene_quantity, what.of.member),                                                     \
     .turns = ENTRY_COMPONENT}
/* A place of a member, and its side. */
#define QUANTITY_SIDE(member)                                                                      \
    {"side",                                                                                       \
     ENTRY_WORD,                                                                                   \
     .words = "from|to",                                                                           \
     .summary = "of 'where', towards that node: resultants jump where a "                          \
                "load acts",                                                                       \
     .usual = "to",                                                                                \
     ENTRY_IN(scene_quantity, what.of.member),                                                     \
     .first = 1,                                                                                   \
     .falls = 1}
#define QUANTITY_ALL_STATES                                                                        \
    (1u << SCENE_STATIC | 1u << SCENE_MOTION | 1u << SCENE_CONTINUATION | 1u << SCENE_ROTATION)

#endif
