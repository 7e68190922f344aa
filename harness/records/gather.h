/* Lists of records of one kind, in the order of the series. */
#ifndef BEAMWORK_GATHER_H
#define BEAMWORK_GATHER_H

#include "harness/records/schema.h"

typedef struct held_record held_record;
typedef struct subjects {
    int count, room;
    subject *row;
    held_record *held; /* that are in no result */
    int bad;           /* 1: out of memory */
} subjects;

/* Truths that quantities are compared with: those of the verdicts; where nothing was judged the
 * stored ones. Both may be NULL. */
typedef struct gathering {
    const sweep *sweep;
    const judgement *judged;
    const truths *truths;
} gathering;

/* Adds the records of all series of a case. */
void gather_case(const gathering *g, const record_type *type, const case_type *of, subjects *out);
/* Adds those of one mesh; a kind that a mesh has none of adds nothing. */
void gather_mesh(const gathering *g, const record_type *type, int series_index, int mesh,
                 subjects *out);
/* One of each formulation that was run here, in the order of the series. */
void gather_declarations(const gathering *g, subjects *out);
/* What is assumed of its sections. */
void gather_assumptions(const sweep_point *p, subjects *out);
subject gather_cell(const gathering *g, int series_index, int mesh);
subject gather_verdict(const gathering *g, const verdict *v);
subject gather_agreement(const gathering *g, const agreement *a);
subject gather_coverage(const gathering *g, const coverage *c, int left_out);
void gather_add(subjects *list, const subject *one);
/* A copy of a record that lives as long as the list; NULL: out of memory. */
const void *gather_keep(subjects *list, const void *record, size_t size);
void gather_free(subjects *list);

#endif
