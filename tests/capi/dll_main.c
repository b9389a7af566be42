int draw_in_c(void);

int main(void) {
  return draw_in_c() == 0 ? 0 : 1;
}
