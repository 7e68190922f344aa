/* Tables of parameters that the user can set: the parameters of a case (--set NAME=VALUE) and the
 * options of a formulation (-f name:NAME=VALUE). Values are stored in the order of the entries. */
#ifndef BEAMWORK_PARAMETER_H
#define BEAMWORK_PARAMETER_H

#ifdef __cplusplus
extern "C" {
#endif

/* An entry of a table. */
typedef struct parameter_type {
    const char *name;    /* NULL ends the table */
    const char *unit;    /* unit in SI, "1" for a plain number, or "" for a choice */
    double value;        /* default value, or the index of the default choice */
    double min, max;     /* inclusive limits, not used for a choice */
    const char *choices; /* words "a|b|c", or NULL for a number */
    const char *summary; /* one line */
} parameter_type;

/* Largest number of consecutive tables. Several tables allow common entries to be defined once. If
 * there are fewer tables, NULL follows the last table. */
enum { PARAMETER_PARTS = 5 };

/* Returns the number of entries of all tables. */
int parameter_count(const parameter_type *const part[PARAMETER_PARTS]);
/* Returns entry i of all tables, or NULL after the last entry. */
const parameter_type *parameter_at(const parameter_type *const part[PARAMETER_PARTS], int i);
/* Returns the index of the entry with this name, or -1. */
int parameter_index(const parameter_type *const part[PARAMETER_PARTS], const char *name);
void parameter_defaults(const parameter_type *const part[PARAMETER_PARTS], double value[]);
/* Returns the number of choices, or 0 if the parameter is a number. */
int parameter_choices(const parameter_type *);

#ifdef __cplusplus
}
#endif

#endif
