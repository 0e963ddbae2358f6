"""What is lost or out of date after batches are killed, their disks fill up or go away, and versions are mixed?"""
