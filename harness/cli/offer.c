#include "harness/cli/offer.h"

#include <string.h>

void offer_text(const offer *o, const char *text, const char *summary)
{
    if (strncmp(text, o->begun, strlen(o->begun)) == 0)
        fprintf(o->to, "%.*s%s\t%s\n", o->length, o->before, text, summary);
}

void offer_choices(const offer *o, const char *choices)
{
    char word[64];
    while (*choices != '\0') {
        const size_t length = strcspn(choices, "|");
        snprintf(word, sizeof word, "%.*s", (int)length, choices);
        offer_text(o, word, "");
        choices += length + (choices[length] == '|');
    }
}

void offer_files(const offer *o)
{
    fprintf(o->to, ":files\n");
}

void offer_folders(const offer *o)
{
    fprintf(o->to, ":folders\n");
}

offer offer_behind(const offer *o, const char *characters)
{
    offer behind = *o;
    for (const char *at = o->begun; *at != '\0'; at++)
        if (strchr(characters, *at) != NULL)
            behind.begun = at + 1;
    behind.length = (int)(o->length + (behind.begun - o->begun));
    return behind;
}
