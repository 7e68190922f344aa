/* How the members of a scene are divided into elements.
 *
 * Where a load along a member begins, ends or acts between its ends there is a node of the mesh, as
 * if the member were cut there: resultants have a kink or a jump at that place, which no element
 * can have inside.  Each of these pieces has as many elements, all of one length, as a whole member
 * has: a mesh of twice as many has all nodes of the one before. */
#ifndef BEAMWORK_DIVISION_H
#define BEAMWORK_DIVISION_H

#include "cases/scene/scene.h"
#include "elements/shared/status.h"

typedef struct division {
    int *first;    /* [members + 1] pieces before those of a member */
    double *place; /* of a member from place[first[member] + member] on, pieces + 1: where they
                      begin and end, 0 .. 1 of its initial length */
    int *each;     /* [members] elements of a piece */
} division;

/* No pieces are shorter than this part of their member: what they would be for lies inside an
 * element. */
#define DIVISION_LEAST 1e-3

/* elements: of a piece, where the member does not say so. */
status division_make(const scene *, int elements, division *, fault *);
void division_free(division *);

int division_pieces(const division *, int member);
int division_elements(const division *, int member);
/* Begin and end of the piece of an element, counted along its member, and the element's number in
 * the piece. */
int division_piece(const division *, int member, int number, double ends[2]);
/* Of a point x in [0, 1] of an element, and the other way round. */
double division_place(const division *, int member, int number, double x);
double division_inside(const division *, int member, int number, double place);
/* The element at a place, with the point in it; between two of them that towards the end, or
 * (before) towards the begin. */
int division_at(const division *, int member, double place, int before, double *x);

#endif
