/* Parameters set by the user: those of a case (--set NAME=VALUE) and options of a formulation (-f
 * name:NAME=VALUE) are entries of such tables, in the order of their values. */
#ifndef BEAMWORK_PARAMETER_H
#define BEAMWORK_PARAMETER_H

#ifdef __cplusplus
extern "C" {
#endif

/* An entry. */
typedef struct parameter_type {
    const char *name;    /* NULL ends the table */
    const char *unit;    /* SI; "1" for a plain number, "" for a choice */
    double value;        /* default; for a choice its index */
    double min, max;     /* inclusive; not used for a choice */
    const char *choices; /* "shear_flow|printed|misprinted", or NULL for a number */
    const char *summary; /* one line */
} parameter_type;

/* Consecutive tables, so that common entries are defined once; NULL after the last if there are
 * fewer. */
enum { PARAMETER_PARTS = 5 };

/* Returns the number of entries of all parts. */
int parameter_count(const parameter_type *const part[PARAMETER_PARTS]);
/* Returns NULL after the last one. */
const parameter_type *parameter_at(const parameter_type *const part[PARAMETER_PARTS], int i);
/* Returns -1 if there is no entry of that name. */
int parameter_index(const parameter_type *const part[PARAMETER_PARTS], const char *name);
void parameter_defaults(const parameter_type *const part[PARAMETER_PARTS], double value[]);
/* Returns the number of choices; 0: the parameter is a number. */
int parameter_choices(const parameter_type *);

#ifdef __cplusplus
}
#endif

#endif
