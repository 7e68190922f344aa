/* What a scene is built with from a checked tree, and values of its maps by their keys.
 *
 * The tree has the form that keys.h says: what is asked for here is a number, a word, a list where
 * one must be. What has no meaning is a mistake, and some value is returned. */
#ifndef BEAMWORK_SCENE_BUILDER_H
#define BEAMWORK_SCENE_BUILDER_H

#include "cases/format/placement.h"
#include "cases/format/units.h"
#include "cases/format/unroll.h"
#include "cases/scene/entry.h"

typedef struct builder {
    arena *arena;
    mistakes *mistakes;
    scene *scene;
    const document_node *root;
    const scope *names; /* parameters and derived values */
    unit_system units;  /* of the numbers in the file */
    struct {
        unrolled *entry;
        int count;
        int incomplete;  /* 1: entries were left out after mistakes */
    } list[SCENE_LISTS]; /* in the order of the scene's indices */
    const char **shared; /* names of warping coordinates that members share */
    int shares;
    int unsaid_warping; /* of ends of which nothing is said */
} builder;

/* One map: of an entry, or below one. */
typedef struct fields {
    builder *b;
    const scope *names;
    const document_node *map; /* NULL: it is not there, and has nothing */
    const document_node *place;
    const placement *placed; /* NULL: in the axes of the scene */
} fields;

fields fields_of(builder *b, const unrolled *entry);
fields fields_below(const fields *f, const char *key);
int fields_have(const fields *f, const char *key);
/* All values of the table that are in the struct of the entry; those of a map that is not there
 * stay as they are. */
void fields_read(const fields *f, const entry_field *table, void *entry);
double fields_number(const fields *f, const char *key, double otherwise);
int fields_whole(const fields *f, const char *key, int otherwise, int least, int most);
/* out[count] is left as it is, and 0 returned, where there is none. */
int fields_vector(const fields *f, const char *key, int count, double out[]);
/* A list or range: how many; 0 where there is none; *out is the arena's. */
int fields_values(const fields *f, const char *key, double **out);
const char *fields_text(const fields *f, const char *key, const char *otherwise);
/* Index in "a|b|c" of a word, or of the word that a parameter of that name has. */
int fields_word(const fields *f, const char *key, const char *choices, int otherwise);
int fields_word_of(const fields *f, const document_node *word, const char *what,
                   const char *choices, int otherwise);
/* Bits of one word or of a list of them. */
unsigned fields_words(const fields *f, const char *key, const char *choices);
/* Index of the entry that is named; SCENE_NONE where there is none. */
int fields_entry(const fields *f, const char *key, scene_list list);
int fields_entry_of(const fields *f, const document_node *name, scene_list list);
/* Is there an entry of that name? Nothing is told. */
int fields_names(const fields *f, const char *key, scene_list list);
/* "ux|uy|uz|rx|ry|rz" */
extern const char fields_components[];

/* Gives an entry of the scene the name that entry i of a list has. */
void builder_call(builder *b, scene_list list, int index, int i);

void builder_sections(builder *b);
void builder_nodes(builder *b);
void builder_members(builder *b);
void builder_springs(builder *b);
void builder_motions(builder *b);
void builder_loads(builder *b);
void builder_analyses(builder *b);
void builder_quantities(builder *b);
/* What the table does not say of a motion in time. */
void builder_in_time(const fields *f, scene_motion *how);
/* Adds a piece to the function of time of an entry of the scene. */
typedef void builder_piece(scene *, int index, double until, const char *text);
/* Adds the function that `time`, `pieces` or `table` gives; values of a table are joined by lines,
 * or by a cubic spline that begins and ends at rest. */
void builder_function(const fields *f, int index, builder_piece *add, int spline);
/* Is there one? */
int builder_has_function(const fields *f);
/* Tells that the analysis of a quantity does not have it, and which kinds of analysis do. */
void builder_no_quantity(const fields *what, const char *key, const scene_quantity *q);
/* `path` and as many `values` as it has stations: their number; 0 after a mistake or where there
 * are none. */
int builder_stations(const fields *f, const char *values, double **path, double **value);
/* Analyses and quantities where the file has none. */
void builder_defaults(builder *b);

#endif
