!> The hash SHA-256: examples of FIPS PUB 180-2, lengths about the ends of blocks, and all bytes, as sha256sum prints them
program test_sha256
   use contact_test_harness, only : test_suite
   use contact_text_sha256, only : sha256
   implicit none (type, external)
   type(test_suite) :: suite
   character(len=256) :: bytes
   integer :: k

   call suite%start("sha256")
   call hash("", "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855", "nothing")
   call hash("abc", "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad", "abc")
   call hash("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq", &
      & "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1", "two blocks")
   call hash(repeat("a", 55), "9f4390f8d30c2dd92ec9f095b65e2b9ae9b0a925a5258e241c9f1e910f734318", "55 letters")
   call hash(repeat("a", 63), "7d3e74a05d7db15bce4ad9ec0658ea98e3f06eeecf16b4c6fff2da457ddc2f34", "63 letters")
   call hash(repeat("a", 64), "ffe054fe7ae0cb6dc65c3af9b61d5209f439851db43d0ba5997337df154668eb", "64 letters")
   call hash(repeat("a", 119), "31eba51c313a5c08226adf18d4a359cfdfd8d2e816b13f4af952f7ea6584dcfb", "119 letters")
   call hash(repeat("a", 120), "2f3d335432c70b580af0e8e1b3674a7c020d683aa5f73aaaedfdc55af904c21c", "120 letters")
   do k = 1, len(bytes)
      bytes(k:k) = achar(k - 1)
   end do
   call hash(repeat(bytes, 40), "e96760a87768717bcebcfd25ddc7d46b4dbc95a4b0014def080c08539f7d90d0", "all bytes")
   call suite%finish()

contains

   subroutine hash(text, expected, what)
      character(len=*), intent(in) :: text, expected, what

      call suite%check(sha256(text) == expected, what)
   end subroutine hash
end program test_sha256
