/* Uses the input as a scene file. An accepted scene is written and read again. Writing this scene
 * must give the same text. An error must have a position. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases/format/format.h"
#include "harness/study/study.h"
#include "harness/tools/fuzz/fuzz.h"

/* Returns the scene at its default values as text, allocated with malloc; NULL: the scene cannot be
 * written. */
static char *written(const scene_file *file, size_t *size)
{
    const case_type *type = scene_file_case(file);
    double value[CASE_MAX_PARAMETERS] = {0};
    char *text = NULL;
    scene s;
    fault f = {""};
    parameter_defaults(type->parameters, value);
    scene_init(&s, type->name);
    fuzz_must(case_build(type, value, &s, &f) == STATUS_OK, "an accepted scene can be built");
    fuzz_must(scene_validate(&s, &f) == STATUS_OK, "and is valid");
    FILE *to = open_memstream(&text, size);
    fuzz_must(to != NULL, "there is memory");
    const write_head head = {type->name, type->summary, type->source};
    const status outcome = write_scene(to, &s, &head, &f);
    fclose(to);
    scene_free(&s);
    if (outcome == STATUS_OK)
        return text;
    free(text);
    return NULL;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char path[] = "scene";
    scene_file *file = NULL, *again = NULL;
    mistakes m;
    fault f = {""};
    const status outcome = scene_file_read_bytes((const char *)data, size, path, &file, &m, &f);
    fuzz_must((outcome == STATUS_OK) == (m.count == 0 && !m.out_of_memory),
              "a rejected scene has an error");
    for (int i = 0; i < m.count; i++)
        fuzz_must(m.list[i].line >= 1 && m.list[i].column >= 1 && m.list[i].text[0] != '\0' &&
                      strchr(m.list[i].text, '\n') == NULL,
                  "a mistake has a position and a text of one line");
    if (outcome != STATUS_OK)
        return 0;
    truths t = {0};
    scene_truths_add_all(file, &t, &f);
    truths_free(&t);
    size_t one = 0, two = 0;
    char *text = written(file, &one), *same = NULL;
    if (text != NULL) {
        fuzz_must(scene_file_read_bytes(text, one, path, &again, &m, &f) == STATUS_OK,
                  "a written scene can be read");
        same = written(again, &two);
        fuzz_must(same != NULL && one == two && memcmp(text, same, one) == 0,
                  "a scene is written in the same way again");
    }
    free(text);
    free(same);
    scene_file_free(again);
    scene_file_free(file);
    return 0;
}
