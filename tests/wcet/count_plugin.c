// Counts the instructions that an emulated core executes: a plugin of QEMU's translator.
//
// Arguments, all optional:
//   watch=ADDRESS   hex, repeated: a function whose every call is written; the first is the cycle
//   calls=FILE      a line for every call of the first: instructions in it and in each of the
//                   others meanwhile, callees included; 0 where one was not called, the sum where
//                   often
//   functions=FILE  a line for every function called: calls min max mean address symbol
//   cover=FILE      a line for every address executed: address size times
//   marks=FILE      a line for every address, hexadecimal, whose execution is an event
//   events=FILE     words of 32 bits in the order of execution: the address of a mark; kCall + the
//                   address behind the call, then the callee's; kReturn + number of calls that end
// Calls are seen by their instructions, BL and BLX, and returns by the address they come back to,
// so a function that another one ends in by a jump counts as part of it. A conditional instruction
// counts whether or not its condition holds. No recursion, one core, no interrupts.
//
// QEMU's package has no header for plugins; what is used of version 1 of the interface is declared
// here.  [QEMU, docs/devel/tcg-plugins]
#include <inttypes.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EXPORT __attribute__((visibility("default")))
typedef uint64_t qemu_plugin_id_t;
typedef struct qemu_info qemu_info_t;
struct qemu_plugin_tb;
struct qemu_plugin_insn;
enum qemu_plugin_cb_flags { QEMU_PLUGIN_CB_NO_REGS };
enum qemu_plugin_op { QEMU_PLUGIN_INLINE_ADD_U64 };
typedef void (*on_execution)(unsigned int, void*);
void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t,
                                           void (*)(qemu_plugin_id_t, struct qemu_plugin_tb*));
void qemu_plugin_register_vcpu_tb_exec_cb(struct qemu_plugin_tb*, on_execution,
                                          enum qemu_plugin_cb_flags, void*);
void qemu_plugin_register_vcpu_insn_exec_cb(struct qemu_plugin_insn*, on_execution,
                                            enum qemu_plugin_cb_flags, void*);
void qemu_plugin_register_vcpu_insn_exec_inline(struct qemu_plugin_insn*, enum qemu_plugin_op,
                                                void*, uint64_t);
void qemu_plugin_register_atexit_cb(qemu_plugin_id_t, void (*)(qemu_plugin_id_t, void*), void*);
size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb*);
struct qemu_plugin_insn* qemu_plugin_tb_get_insn(const struct qemu_plugin_tb*, size_t);
const void* qemu_plugin_insn_data(const struct qemu_plugin_insn*);
size_t qemu_plugin_insn_size(const struct qemu_plugin_insn*);
uint64_t qemu_plugin_insn_vaddr(const struct qemu_plugin_insn*);
const char* qemu_plugin_insn_symbol(const struct qemu_plugin_insn*);
EXPORT int qemu_plugin_version = 1;

typedef struct {
  uint64_t address, times, size;
  const char* symbol;
} Instruction;
typedef struct {
  uint64_t address, calls, min, max, sum;
  int watched;  // its column, -1: none
  const char* symbol;
} Function;

enum { kCall = 1 << 30, kReturn = 1 << 29 };
enum { kMarks = 1 << 14 };
enum { kInstructions = 1 << 18, kFunctions = 1 << 14, kDepth = 256, kColumns = 32, kTailCalls = 4 };
static Instruction instructions[kInstructions];  // open addressing, by address
static Function functions[kFunctions];
static uint64_t total;
static struct {
  uint64_t return_address, start;
  Function* function;
} stack[kDepth];
static int depth;
static bool called;  // the next block is a callee's first
static uint64_t watched[kColumns], row[kColumns];
static int columns;
static FILE *calls_file, *functions_file, *cover_file, *events_file;
static uint64_t marks[kMarks];
static size_t mark_count;

static void fail(const char* why) {
  fprintf(stderr, "count_plugin: %s\n", why);
  exit(2);
}
static Instruction* instruction_at(uint64_t address) {
  for (uint32_t i = (uint32_t)((address >> 1) * 2654435761U) >> 14, n = 0; n < kInstructions;
       ++i, ++n) {
    Instruction* found = &instructions[i % kInstructions];
    if (found->size == 0 || found->address == address) return found;
  }
  fail("too many instructions");
  return NULL;
}
static Function* function_at(const Instruction* first) {
  for (uint32_t i = (uint32_t)((first->address >> 1) * 2654435761U) >> 18, n = 0; n < kFunctions;
       ++i, ++n) {
    Function* found = &functions[i % kFunctions];
    if (found->symbol != NULL && found->address == first->address) return found;
    if (found->symbol != NULL) continue;
    *found = (Function){.address = first->address, .min = UINT64_MAX, .watched = -1};
    found->symbol = first->symbol != NULL ? first->symbol : "?";
    for (int k = 0; k < columns; ++k)
      if (watched[k] == first->address) found->watched = k;
    return found;
  }
  fail("too many functions");
  return NULL;
}

static void write_event(uint64_t word) {
  const uint32_t event = (uint32_t)word;
  if (events_file != NULL && fwrite(&event, sizeof event, 1, events_file) != 1) fail("events");
}
static void on_mark(unsigned int core, void* context) {
  (void)core;
  write_event(((const Instruction*)context)->address);
}
static void write_row(void) {
  for (int k = 0; k < columns; ++k)
    fprintf(calls_file, k + 1 < columns ? "%" PRIu64 " " : "%" PRIu64 "\n", row[k]);
}
static void end_call(Function* function, uint64_t count) {
  if (count < function->min) function->min = count;
  if (count > function->max) function->max = count;
  function->sum += count;
  ++function->calls;
  if (function->watched < 0) return;
  row[function->watched] += count;
  if (function->watched == 0 && calls_file != NULL) write_row();
}
/// A block begins: the first of a callee, the one behind a call that has returned, or neither.
static void on_block(unsigned int core, void* context) {
  (void)core;
  const Instruction* first = context;
  if (called) {
    called = false;
    Function* function = function_at(first);
    stack[depth].function = function;
    stack[depth].start = total;
    write_event(kCall + stack[depth].return_address);
    write_event(first->address);
    ++depth;
    if (function->watched == 0) memset(row, 0, sizeof row);
    return;
  }
  for (int d = depth - 1; d >= 0 && d >= depth - kTailCalls; --d) {
    if (stack[d].return_address != first->address) continue;
    write_event(kReturn + (uint64_t)(depth - d));
    depth = d;
    end_call(stack[d].function, total - stack[d].start);
    return;
  }
}
static void on_call(unsigned int core, void* context) {
  (void)core;
  const Instruction* call = context;
  if (depth == kDepth) fail("calls too deep");
  stack[depth].return_address = call->address + call->size;
  called = true;
}
static bool is_call(const unsigned char* bytes, size_t size) {
  const unsigned first = bytes[0] | (unsigned)bytes[1] << 8;
  if (size == 2) return (first & 0xff87) == 0x4780;  // BLX register
  const unsigned second = bytes[2] | (unsigned)bytes[3] << 8;
  return (first & 0xf800) == 0xf000 && (second & 0xd000) == 0xd000;  // BL
}
static int by_address(const void* a, const void* b) {
  const uint64_t x = *(const uint64_t*)a, y = *(const uint64_t*)b;  // address is the first member
  return x < y ? -1 : x > y;
}
static void on_translation(qemu_plugin_id_t id, struct qemu_plugin_tb* block) {
  (void)id;
  const size_t count = qemu_plugin_tb_n_insns(block);
  for (size_t k = 0; k < count; ++k) {
    struct qemu_plugin_insn* insn = qemu_plugin_tb_get_insn(block, k);
    Instruction* at = instruction_at(qemu_plugin_insn_vaddr(insn));
    if (at->size == 0) {
      at->address = qemu_plugin_insn_vaddr(insn);
      at->size = qemu_plugin_insn_size(insn);
      at->symbol = qemu_plugin_insn_symbol(insn);
    }
    if (k == 0) qemu_plugin_register_vcpu_tb_exec_cb(block, on_block, QEMU_PLUGIN_CB_NO_REGS, at);
    qemu_plugin_register_vcpu_insn_exec_inline(insn, QEMU_PLUGIN_INLINE_ADD_U64, &total, 1);
    qemu_plugin_register_vcpu_insn_exec_inline(insn, QEMU_PLUGIN_INLINE_ADD_U64, &at->times, 1);
    if (bsearch(at, marks, mark_count, sizeof *marks, by_address) != NULL)
      qemu_plugin_register_vcpu_insn_exec_cb(insn, on_mark, QEMU_PLUGIN_CB_NO_REGS, at);
    if (is_call(qemu_plugin_insn_data(insn), qemu_plugin_insn_size(insn)))
      qemu_plugin_register_vcpu_insn_exec_cb(insn, on_call, QEMU_PLUGIN_CB_NO_REGS, at);
  }
}

static void on_end(qemu_plugin_id_t id, void* context) {
  (void)id;
  (void)context;
  if (functions_file != NULL) {
    qsort(functions, kFunctions, sizeof *functions, by_address);
    for (const Function* f = functions; f < functions + kFunctions; ++f)
      if (f->calls > 0)
        fprintf(functions_file, "%" PRIu64 " %" PRIu64 " %" PRIu64 " %" PRIu64 " %" PRIx64 " %s\n",
                f->calls, f->min, f->max, f->sum / f->calls, f->address, f->symbol);
    fclose(functions_file);
  }
  if (cover_file != NULL) {
    qsort(instructions, kInstructions, sizeof *instructions, by_address);
    for (const Instruction* i = instructions; i < instructions + kInstructions; ++i)
      if (i->times > 0)
        fprintf(cover_file, "%" PRIx64 " %" PRIu64 " %" PRIu64 "\n", i->address, i->size, i->times);
    fclose(cover_file);
  }
  if (calls_file != NULL) fclose(calls_file);
  if (events_file != NULL) fclose(events_file);
}
static bool read_marks(const char* argument) {
  if (strncmp(argument, "marks=", 6) != 0) return false;
  FILE* file = fopen(argument + 6, "r");
  if (file == NULL) fail(argument);
  while (fscanf(file, "%" SCNx64, &marks[mark_count]) == 1)
    if (++mark_count == kMarks) fail("too many marks");
  fclose(file);
  qsort(marks, mark_count, sizeof *marks, by_address);
  return true;
}
static bool open_output(const char* argument, const char* key, FILE** file) {
  const size_t length = strlen(key);
  if (strncmp(argument, key, length) != 0) return false;
  *file = fopen(argument + length, "w");
  if (*file == NULL) fail(argument);
  return true;
}
EXPORT int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info_t* info, int count,
                               char** arguments) {
  (void)info;
  for (int i = 0; i < count; ++i) {
    const char* argument = arguments[i];
    if (strncmp(argument, "watch=", 6) == 0) {
      if (columns == kColumns) fail("too many functions to watch");
      watched[columns++] = strtoull(argument + 6, NULL, 16) & ~(uint64_t)1;
    } else if (!open_output(argument, "calls=", &calls_file) &&
               !open_output(argument, "functions=", &functions_file) &&
               !open_output(argument, "events=", &events_file) && !read_marks(argument) &&
               !open_output(argument, "cover=", &cover_file)) {
      fail(argument);
    }
  }
  qemu_plugin_register_vcpu_tb_trans_cb(id, on_translation);
  qemu_plugin_register_atexit_cb(id, on_end, NULL);
  return 0;
}
