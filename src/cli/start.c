/* Before the libraries of the program are initialised: from here on, refused requests for memory are looked after in all of them */
void contact_guard_whole_process(void);
#if defined(__linux__) && defined(__ELF__)
static void start(int count, char **words, char **environment) {
  (void)count;
  (void)words;
  (void)environment;
  contact_guard_whole_process();
}
__attribute__((section(".preinit_array"), used)) static void (*const first)(int, char **, char **) = start;
#else
__attribute__((constructor)) static void first(void) { contact_guard_whole_process(); }
#endif
