/* Uses the input as a truths.h5 with unexpected contents (even first byte), or as arbitrary bytes.
 */
#include "harness/study/study.h"
#include "harness/tools/fuzz/fuzz_alter.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    truths t;
    glossary g;
    fault f = {""}, why = {""};
    if (size == 0)
        return 0;
    const char *path = data[0] & 1 ? fuzz_file(data, size) : alter_file(data + 1, size - 1);
    const status outcome = truths_read(path, &t, &f), words = glossary_read(path, &g, &why);
    fuzz_must((outcome == STATUS_OK) == (f.text[0] == '\0') && strchr(f.text, '\n') == NULL,
              "a rejection has a one-line error");
    fuzz_must((words == STATUS_OK) == (why.text[0] == '\0') && strchr(why.text, '\n') == NULL,
              "a rejected glossary has a one-line error");
    fuzz_must(H5Fget_obj_count((hid_t)H5F_OBJ_ALL, H5F_OBJ_ALL) == 0, "nothing stays open");
    if (outcome == STATUS_OK)
        truths_free(&t);
    if (words == STATUS_OK)
        glossary_free(&g);
    return 0;
}
