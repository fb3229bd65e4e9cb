; find the bolt hole in the plate by feel, and come back over it
        TRANS   ABOVE [24 36 4 90 90 0]
        OPEN    .5
        MOVE    ABOVE
        SEARCH  .1
L1      MOVE    ABOVE
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] .8
        SKIPE   23
        AOJ     L1
        SAVE    HOLE
        CHANGE  Z 2
        MOVE    ABOVE
        RESTORE HOLE LEVEL
        PARK
