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
    const char *unit;    /* SI; "1" for a plain number, "" for a choice */
    double value;        /* default; for a choice its index */
    double min, max;     /* inclusive; not used for a choice */
    const char *choices; /* "shear_flow|printed|misprinted", or NULL for a number */
    const char *summary; /* one line */
} parameter_type;

/* Largest number of consecutive tables; several tables allow common entries to be defined once.
 * NULL follows the last table if there are fewer. */
enum { PARAMETER_PARTS = 5 };

/* Returns the number of entries of all parts. */
int parameter_count(const parameter_type *const part[PARAMETER_PARTS]);
/* Returns entry i of all parts, or NULL after the last one. */
const parameter_type *parameter_at(const parameter_type *const part[PARAMETER_PARTS], int i);
/* Returns the index of the entry with this name, or -1. */
int parameter_index(const parameter_type *const part[PARAMETER_PARTS], const char *name);
void parameter_defaults(const parameter_type *const part[PARAMETER_PARTS], double value[]);
/* Returns the number of choices; 0: the parameter is a number. */
int parameter_choices(const parameter_type *);

#ifdef __cplusplus
}
#endif

#endif
