/* Expressions that choose cells: -k "c_column and not beamw_first". */
#ifndef BEAMWORK_SELECT_H
#define BEAMWORK_SELECT_H

/* Does an expression (words joined by and, or, not; a word is looked for in text) hold? -1:
 * malformed. */
int select_matches(const char *expression, const char *text);

#endif
