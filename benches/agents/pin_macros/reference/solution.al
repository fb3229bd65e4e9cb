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
        AOJ     L
L:      AGAIN   .12 -25
        SKIPE   23
        AOJ     L
IN:     SEAT    .35 -.98 -.78
