/* The short table of a run: a row for each series, small enough to be committed and read in a
 * diff. */
#ifndef BEAMWORK_RESULTS_TABLE_H
#define BEAMWORK_RESULTS_TABLE_H

/* Columns, as harness/README.md explains them. */
extern const char results_table_head[];

/* Digits of what is written, which is as near as two runs can be compared. */
enum { RESULTS_ERROR_DIGITS = 6, RESULTS_LIMIT_DIGITS = 10, RESULTS_DECADES_DECIMALS = 6 };

#endif
