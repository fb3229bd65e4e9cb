        REQUIRE macros.al

        STAGE   "fetch the pin"
        FETCH   PIN 1.5
        MOVE    HOLE

        STAGE   "insert it"
        SAVE    START
        FEEL    .25 -25
        SKIPN   23
        JUMP    IN
        SAVE    TOUCH
        SEARCH  .07 STEPS 4
L:      NEXT
        FEEL    .12 -25
        SKIPE   23
        JUMP    L
IN:     SEAT    .35 -.98 -.78
