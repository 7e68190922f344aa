/* Rows of a table of truths, each checked. */
#ifndef BEAMWORK_TRUTH_ROWS_H
#define BEAMWORK_TRUTH_ROWS_H

#include "harness/study/columns.h"
#include "harness/study/truths.h"

/* The first column of a row that makes no sense, or NULL. */
const char *truth_rows_wrong(const truth *row);
/* row[table->rows], zero before. FAULT: a column that makes no sense, or a row whose case has other
 * defaults by now; what was read stays for truths_free. */
status truth_rows_read(const table_columns *table, const case_type *type, truth row[]);

#endif
