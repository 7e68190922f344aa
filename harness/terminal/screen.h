/* What a terminal can show: colour, signs beyond ASCII. */
#ifndef BEAMWORK_SCREEN_H
#define BEAMWORK_SCREEN_H

#include <stdio.h>

typedef struct screen {
    int colour; /* 1: a terminal that knows colours, and nobody asked for none (NO_COLOR) */
    int utf8;   /* 1: the locale has signs beyond ASCII */
} screen;

typedef enum screen_ink { SCREEN_PLAIN, SCREEN_GOOD, SCREEN_BAD, SCREEN_FAINT } screen_ink;

screen screen_of(FILE *to);
/* The text in that ink; never an escape sequence where there is no colour. */
void screen_put(FILE *to, screen, screen_ink, const char *text);

#endif
