/* Uses the input as a results.h5 with unexpected contents (even first byte), or as arbitrary bytes.
 */
#include "harness/records/records.h"
#include "harness/tools/fuzz/fuzz_alter.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    stored_results r;
    fault f = {""};
    if (size == 0)
        return 0;
    const status outcome = results_read_any(
        data[0] & 1 ? fuzz_file(data, size) : alter_file(data + 1, size - 1), NULL, &r, &f);
    fuzz_must((outcome == STATUS_OK) == (f.text[0] == '\0') && strchr(f.text, '\n') == NULL,
              "a rejection has a one-line error");
    fuzz_must(H5Fget_obj_count((hid_t)H5F_OBJ_ALL, H5F_OBJ_ALL) == 0, "nothing stays open");
    results_free(&r);
    return 0;
}
