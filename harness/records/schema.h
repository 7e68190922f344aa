/* One schema for all records: a table of fields for each kind of record, from which HDF5, JSON, CSV
 * and `beamwork schema` are written, with the same names. A new field is one line of a table. */
#ifndef BEAMWORK_SCHEMA_H
#define BEAMWORK_SCHEMA_H

#include <stddef.h>

#include "harness/study/study.h"

enum { SCHEMA_VERSION = 3, SCHEMA_OLDEST = 2, SCHEMA_MOST_FIELDS = 96, FIELD_ROOM = 2048 };
#define SCHEMA_NAME "beamwork-results"
/* Of a number that is in the unit which the record's own field `unit` names. */
#define OWN_UNIT "unit"

/* Of a field that says where the record belongs. KEY_AROUND: only where nothing around the record
 * says so (CSV, lists of JSON). */
enum { KEY = 1, KEY_AROUND = 2 };

typedef enum field_kind {
    FIELD_INT,
    FIELD_LONG,
    FIELD_DOUBLE,
    FIELD_FLAG,
    FIELD_TEXT,
    FIELD_ENUM,
    FIELD_KINDS
} field_kind;

/* A record in its surroundings; what does not apply is NULL (numbers: 0). */
typedef struct subject {
    const sweep *sweep;
    const sweep_point *point;
    const series *series;
    int mesh;           /* of the series */
    const void *record; /* what most offsets refer to */
    int index;          /* among its like: of a quantity, a step, an iteration, a station */
    int group;          /* step that an iteration belongs to; first point of a curve */
    const verdict *verdict;
    const truth *truth, *model_truth; /* that a quantity is compared with */
    const void *owner;                /* what the record is part of */
} subject;

/* What surrounds a record: offsets may refer to it. */
typedef enum field_base {
    BASE_RECORD,
    BASE_SUBJECT,
    BASE_POINT,
    BASE_CASE, /* case_type */
    BASE_SERIES,
    BASE_FORMULATION, /* element_type */
    BASE_CELL,
    BASE_QUANTITY, /* scene_quantity that the index counts */
    BASE_TRUTH,
    BASE_MODEL_TRUTH
} field_base;

typedef struct schema_field schema_field;
/* The member that the kind names is set. */
typedef struct field_value {
    const schema_field *of;
    long whole;            /* INT, LONG, FLAG, ENUM */
    const double *numbers; /* DOUBLE: [count of the field]; NAN: there is none */
    const char *text;      /* TEXT, ENUM (its word) */
    double number;         /* room for one number ... */
    char room[FIELD_ROOM]; /* ... and for a text that is put together */
} field_value;

typedef void field_getter(const subject *s, field_value *out);

struct schema_field {
    const char *name, *unit; /* "1": a number without; "": not a number */
    field_kind kind;
    const char *summary;
    field_base base; /* that the offset refers to; where it is NULL there is no value */
    size_t offset;
    int address;              /* 1: a TEXT of which the address stands there */
    field_getter *get;        /* derived: instead of what stands at the offset */
    const char *(*word)(int); /* ENUM: its words ... */
    int words;                /* ... 0 to words - 1 */
    int count;                /* DOUBLE: numbers of an array (a square matrix); 0: a single one */
    int key;                  /* KEY, KEY_AROUND, or 0: it is what was found */
};

/* What stands in a member of the record. */
#define AT(type, member) .offset = offsetof(type, member)
/* In a member of what surrounds it; the same, the address of a text. */
#define OF(place, type, member)      .base = BASE_##place, .offset = offsetof(type, member)
#define TEXT_OF(place, type, member) OF(place, type, member), .address = 1

/* Tables end with a field without name. */
enum { RECORD_PARTS = 5 };
typedef struct record_type {
    const char *name, *table, *summary;     /* table: in HDF5 and lists of JSON */
    const schema_field *part[RECORD_PARTS]; /* one after the other; NULL: no more */
} record_type;

/* A series of meshes, one mesh of it, what it found and how, its time, what the judge says. */
extern const record_type record_point, record_series, record_cell, record_quantity, record_curve,
    record_step, record_iteration, record_event, record_motion, record_matrix, record_timing,
    record_verdict, record_agreement, record_coverage, record_import, record_scene,
    record_parameter, record_meaning, record_assumption;
extern const record_type *const record_types[]; /* all of them; ends with NULL */
extern const record_type record_omission;       /* of a value, in the CSV of a solution only */
extern const record_type record_truth;          /* of a quantity, in JSON only */
extern const record_type record_declaration;    /* of a whole run, in HDF5 only */

/* Pointers to the fields whose key is at most `keys`, in order; their number. */
int schema_fields(const record_type *type, int keys, const schema_field *out[SCHEMA_MOST_FIELDS]);
void schema_read(const subject *s, const schema_field *which, field_value *out);
const char *schema_kind_name(field_kind kind);
/* Helps getters: a text that may be NULL, a number. */
void schema_set_text(field_value *out, const char *text);
void schema_set_number(field_value *out, double number);

#endif
