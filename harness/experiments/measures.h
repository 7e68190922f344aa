/* What is measured of a formulation, whatever it claims: errors over meshes and thicknesses,
 * orders. Plain data of one size: it can lie in memory that processes share. */
#ifndef BEAMWORK_MEASURES_H
#define BEAMWORK_MEASURES_H

enum { MEASURE_POINTS = 12, MEASURES_MOST = 16, MEASURE_NAME = 64, MEASURE_WORDS = 200 };

typedef struct element_measure {
    char name[MEASURE_NAME];
    int points;
    double at[MEASURE_POINTS];    /* numbers of elements, or thickness by length */
    double error[MEASURE_POINTS]; /* relative to the exact value; NAN: none */
    double order;                 /* of the errors; NAN: not asked for, or none is seen */
    int least, highest;           /* orders that the type declares; 0: not asked for */
    int locks;                    /* 1: the errors grow where it becomes thin */
    int astray; /* 1: the error of a linear state is that of one element with every mesh */
    char words[MEASURE_WORDS]; /* why there is nothing, or what it comes to */
} element_measure;

typedef struct measures {
    int count;
    element_measure measure[MEASURES_MOST];
    char words[MEASURE_WORDS]; /* what all of them have in common; "": nothing */
} measures;

/* The next one, empty. */
element_measure *measures_add(measures *m, const char *name);
/* One more point of it. */
void measures_point(element_measure *one, double at, double error);
/* Those whose limit is wrong. */
int measures_astray(const measures *m);
/* 1: three points or more, and none has a value. */
int measures_hopeless(const element_measure *one);

#endif
